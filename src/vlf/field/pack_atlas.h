#pragma once
// Places the charts' rectangles in the atlas.

#include "vlf/field/chart.h"

#include <cstdint>
#include <vector>

namespace vlf {

struct AtlasSize {
    std::uint32_t width = 0, height = 0;
};

/// Sets x and y of every chart so that the rectangles, each with its gutter, do not overlap, and
/// returns the atlas' size. Shelf packing by falling height: fills 90 % and more of the atlas for
/// the charts of usual rooms.
AtlasSize packCharts(std::vector<Chart>& charts);

}  // namespace vlf
