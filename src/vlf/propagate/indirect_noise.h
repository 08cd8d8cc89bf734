#pragma once
// How noisy the indirect light that the last sweeps have gathered is.

#include "vlf/propagate/texel_buffer.h"
#include "vlf/unwrap/unwrap.h"

#include <cmath>
#include <span>
#include <vector>

namespace vlf {

/// The directions that texels have gathered from.
struct SweptDirections {
    double lines = 0;     ///< of all sweeps
    double spacing = 1;   ///< √(513 / l) of a set of l lines; the mean over all lines
    bool turned = false;  ///< sets in random rotation, whose directions do not lie in walls' planes
};

/// SweptDirections::spacing of a set.
inline double spacingOf(int lines) {
    return std::sqrt(513.0 / lines);
}

/// Variance of the irradiance π ΣL / n of unwrap.texels, summed over the channels, (W·m⁻²)², from
/// the spread of `parts`, independent sets of directions, both smoothed or not. Of texels that have
/// gathered most by rays of their own, which are in `gathered` alone, from the variance that a
/// sample has elsewhere.
///
/// All directions together are more even than the parts are, the more so the more samples a texel
/// has of each line, which then vary by the direction alone.
std::vector<float> indirectVariance(const Unwrap& unwrap, std::span<const TexelBuffer> parts,
                                    const TexelBuffer& gathered, const SweptDirections& swept);

}  // namespace vlf
