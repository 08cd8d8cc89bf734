#pragma once
// Choosing points on the scene's emitters.

#include "vlf/math/random.h"
#include "vlf/scene/scene.h"

#include <vector>

namespace vlf {

/// Picks emitting triangles in proportion to their power (area x mean emission, with the texture,
/// of all emitting sides), then a uniform point within.
class EmitterSampler {
  public:
    explicit EmitterSampler(const Scene& scene);

    /// True if nothing in the scene emits.
    bool empty() const { return triangles_.empty(); }

    /// A random point on an emitter, on its front side. Precondition: not empty.
    SidePoint sample(RandomStream& random) const;

    /// Density of sample() on a triangle, per m²; 0 for a triangle it never picks.
    float density(std::uint32_t triangle) const {
        return triangle < densities_.size() ? densities_[triangle] : 0;
    }

  private:
    std::vector<std::uint32_t> triangles_;
    std::vector<double> cumulative_;  ///< power of all triangles_ up to and with this one
    std::vector<float> densities_;    ///< per scene triangle
};

/// Mean radiance emitted by a triangle's emitting side, W·m⁻²·sr⁻¹; textures are sampled at about
/// the texels under the triangle, 64 x 64 at most.
Vec3 meanEmission(const Scene& scene, std::uint32_t triangle);

}  // namespace vlf
