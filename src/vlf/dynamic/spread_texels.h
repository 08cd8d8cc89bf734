#pragma once
// Texels that no surface covers take what the covered ones of their chart have.

#include "vlf/field/chart.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// In a map by atlas texel every entry of the chart and its gutter that is `none` takes that of the
/// nearest one that is not, ring by ring.
void spreadOverChart(const Chart& chart, std::uint32_t atlasWidth, std::uint32_t none,
                     std::vector<std::uint32_t>& map);

}  // namespace vlf
