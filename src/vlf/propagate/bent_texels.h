#pragma once
// Texels whose shading normal differs from the surface's own: facets that stand for a curved
// surface.

#include "vlf/propagate/texel_buffer.h"
#include "vlf/scene/scene.h"
#include "vlf/unwrap/unwrap.h"

#include <cstdint>
#include <vector>

namespace vlf {

struct BentTexel {
    std::uint32_t texel;      ///< atlas index
    Vec3 shading, geometric;  ///< mean normals on the texel's side
};

/// The bent among unwrap.texels.
std::vector<BentTexel> findBentTexels(const Scene& scene, const Unwrap& unwrap);

/// What a bent texel has gathered.
struct BentSum {
    Vec3 rgb{0};
    float weight = 0;
};

/// Sums of what bent texels gather. The rays of a bundle that hit a texel are spread by the cosine
/// of the geometric normal n_g; irradiance about the shading normal n_s weighs them by
/// (n_s·ω)⁺ / |n_g·ω|.
class BentSums {
  public:
    /// Goes on from `sums`, one for each of `texels`, or empty at the beginning.
    BentSums(const std::vector<BentTexel>& texels, std::vector<BentSum>& sums)
        : texels_(texels), sums_(sums) {
        sums.resize(texels.size());
    }

    /// Takes what these texels have gathered along one direction, both senses, out of `gathered`.
    void take(const Vec3& direction, TexelBuffer& gathered);

    /// Puts the sums back.
    void putBack(TexelBuffer& gathered) const;

  private:
    const std::vector<BentTexel>& texels_;
    std::vector<BentSum>& sums_;
};

}  // namespace vlf
