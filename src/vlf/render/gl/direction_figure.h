#pragma once
// The ball of a direction set by OpenGL, see render/drawing/direction_ball.h.

#include "vlf/field/direction_set.h"
#include "vlf/render/gl/figure_buffer.h"
#include "vlf/scene/scene.h"

#include <cstdint>

namespace vlf::gl {

class DirectionFigure {
  public:
    explicit DirectionFigure(const DirectionSet& set);

    /// Into the room, whose depth is there, with the view of shared::kViewBlock.
    void draw(GLuint program, const Sphere& ball);

    std::uint64_t bytes() const { return triangles_.bytes + directionBytes_; }

  private:
    FigureBuffer triangles_;
    Buffer directions_, data_;
    TextureObject directionTexture_;
    std::uint64_t directionBytes_ = 0;
    float meanDistance_ = 0;  ///< root of the mean solid angle
    int lines_ = 0;
};

}  // namespace vlf::gl
