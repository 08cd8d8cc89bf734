#pragma once
// The last sweep's noise taken out of the indirect light, where it is noise.

#include "vlf/propagate/texel_buffer.h"
#include "vlf/unwrap/unwrap.h"

#include <span>

namespace vlf {

/// Moves the radiance that unwrap.texels have gathered towards the mean with their neighbours in
/// the chart, as far as the difference is noise (a Wiener filter), first of neighbours next to them
/// and then of those one further. How large noise is tells the spread of the same difference among
/// `parts`, independent sets of directions; `gathered` holds all samples. Both are changed alike,
/// their numbers of samples stay. Where light truly differs from texel to texel nothing is changed.
void smoothIndirect(const Unwrap& unwrap, std::span<TexelBuffer> parts, TexelBuffer& gathered);

}  // namespace vlf
