#pragma once
// How noisy the indirect light that the last sweeps have gathered is.

#include "vlf/propagate/texel_buffer.h"
#include "vlf/unwrap/unwrap.h"

#include <span>
#include <vector>

namespace vlf {

/// Variance of the irradiance π ΣL / n of unwrap.texels, summed over the channels, (W·m⁻²)², from
/// the differences of `parts`, both smoothed or not: each has every kAccumulators-th line of the
/// sets of directions, the next part the lines beside these. `turned`: the sets are in random
/// rotation.
///
/// Where light changes slowly with the direction so do the parts from one to the next, and all
/// together are far more even than any of them: no noise. Noise jumps from part to part. Texels
/// that have gathered most by rays of their own, which are in `gathered` alone, have the variance
/// that a sample has elsewhere.
std::vector<float> indirectVariance(const Unwrap& unwrap, std::span<const TexelBuffer> parts,
                                    const TexelBuffer& gathered, bool turned);

}  // namespace vlf
