#pragma once
// The last sweep's noise taken out of the indirect light, where it is noise.

#include "vlf/propagate/texel_buffer.h"
#include "vlf/unwrap/unwrap.h"

#include <vector>

namespace vlf {

/// Indirect irradiance π ΣL / n (W·m⁻²) at each of unwrap.texels, moved towards the mean with its
/// neighbours in the chart as far as the difference is noise (a Wiener filter). How large noise is
/// tells the spread of the same difference among `parts`, independent sets of directions;
/// `gathered` holds all samples. Where light truly differs from texel to texel nothing is changed;
/// 0 where no ray has been.
std::vector<Vec3> smoothIndirect(const Unwrap& unwrap, const std::vector<TexelBuffer>& parts,
                                 const TexelBuffer& gathered);

}  // namespace vlf
