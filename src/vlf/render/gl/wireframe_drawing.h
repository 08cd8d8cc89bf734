#pragma once
// Mode wireframe by OpenGL: as drawWireframe of render/cpu, the lines hidden by the room's depth
// instead of rays.

#include "vlf/render/gl/line_pass.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace vlf::gl {

class WireframeDrawing {
  public:
    explicit WireframeDrawing(const Scene& scene);

    /// `drawTriangles` draws those of room and objects, see LinePass::beginDepth; `drawLines` the
    /// objects' lines.
    void draw(LinePass& pass, const View& view, bool normals,
              const std::function<void()>& drawTriangles,
              const std::function<void(LinePass&)>& drawLines, GLuint framebuffer);

    std::uint64_t bytes() const { return edges_.bytes + (normals_ ? normals_->bytes : 0); }

  private:
    const Scene& scene_;
    Sphere sphere_;
    LineBuffer edges_;
    std::optional<LineBuffer> normals_;
};

}  // namespace vlf::gl
