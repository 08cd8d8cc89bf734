#pragma once
// What mirror objects show in mode field: cube maps of the room seen from the objects' middles.
// dynamic/reflection_probe.h is the same on the CPU.

#include "vlf/math/vector.h"
#include "vlf/render/gl/gl_object.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vlf::gl {

class ReflectionProbes {
  public:
    static constexpr int kSize = 128;  ///< texels along a face

    /// Draws what is seen through a face: into the bound framebuffer, with this viewport.
    using DrawFace =
        std::function<void(const Mat4& clipFromWorld, const Vec3& eye, GLuint framebuffer)>;

    /// All faces anew of probes at these centres; the near plane lies `nearest` metres before them.
    void draw(const std::vector<Vec3>& centres, float nearest, const DrawFace& drawFace);

    /// Binds them to shared::kProbeUnit.
    void bind() const;

    std::uint64_t bytes() const;

  private:
    void require(std::size_t probes);

    std::size_t capacity_ = 0;
    TextureObject cubes_, depth_;  ///< radiance and 1 / distance, by layer
    Framebuffer framebuffer_;
};

}  // namespace vlf::gl
