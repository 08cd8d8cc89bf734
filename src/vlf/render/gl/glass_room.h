#pragma once
// The room as glass around a tile of a subfield, painted from far to near.

#include "vlf/field/light_field.h"
#include "vlf/render/drawing/subfield_drawing.h"
#include "vlf/render/gl/figure_buffer.h"
#include "vlf/render/gl/line_pass.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <map>
#include <vector>

namespace vlf::gl {

class GlassRoom {
  public:
    /// `colors` of the charts that the tile's rays meet.
    GlassRoom(const Scene& scene, const LightField& field, const SubfieldSelection& selection,
              const std::map<std::uint32_t, Vec3>& colors);

    /// Paints on paper; returns the picture, display-linear, which is at least as large as the
    /// view.
    const TextureObject& draw(GLuint program, const View& view);

    std::uint64_t bytes() const;

  private:
    void sortFrom(const Vec3& eye);

    FigureBuffer panes_;
    Buffer data_, order_;
    DrawingTarget target_;
    std::vector<Vec3> centres_;  ///< of the panes
    Vec3 sortedFrom_{0};
    bool sorted_ = false;
};

}  // namespace vlf::gl
