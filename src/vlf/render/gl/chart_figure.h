#pragma once
// The texels of one chart by OpenGL: its triangles, coloured by the irradiance atlas.

#include "vlf/field/light_field.h"
#include "vlf/render/gl/figure_buffer.h"
#include "vlf/scene/scene.h"

#include <cstdint>

namespace vlf::gl {

class ChartFigure {
  public:
    ChartFigure(const Scene& scene, const LightField& field, std::uint32_t chart);

    std::uint32_t chart() const { return chart_; }

    /// Over the room just drawn, with the view of shared::kViewBlock.
    void draw(GLuint program, GLuint irradianceAtlas);

    std::uint64_t bytes() const { return triangles_.bytes; }

  private:
    std::uint32_t chart_;
    FigureBuffer triangles_;
    Buffer data_;
    TextureObject heat_;
};

}  // namespace vlf::gl
