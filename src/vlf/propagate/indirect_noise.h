#pragma once
// How noisy the indirect light that the last sweeps have gathered is.

#include "vlf/propagate/texel_buffer.h"
#include "vlf/unwrap/unwrap.h"

#include <span>
#include <vector>

namespace vlf {

/// Variance of the irradiance π ΣL / n of unwrap.texels, summed over the channels, (W·m⁻²)², from
/// the spread of `parts`, independent sets of directions, both smoothed or not. Of texels that have
/// gathered most by rays of their own, which are in `gathered` alone, from the variance that a
/// sample has elsewhere. `evenness`: see below.
std::vector<float> indirectVariance(const Unwrap& unwrap, std::span<const TexelBuffer> parts,
                                    const TexelBuffer& gathered, float evenness);

/// Variance of what a direction set gathers to that of its parts if these were independent: a set
/// is more even than its parts are, the more so the more of a texel's samples a line has, which
/// then vary by the direction alone. `samplesPerLine`: of a texel, in the mean; `turned`: a set in
/// random rotation, whose directions do not lie in the walls' planes.
float evennessOf(int lines, double samplesPerLine, bool turned);

}  // namespace vlf
