#pragma once
// Which cells of a rough mirror show the same: those of its guard band, and of charts smaller than
// a cell, stand for points of the chart that lie close together.

#include "vlf/math/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// A point of a surface and its unit normal.
struct ViewPoint {
    Vec3 position{0};
    Vec3 normal{0};
};

/// For each point the first of those within the same cube of edge `size` (metres), with about the
/// same normal; itself if it is the first. Points further apart than √3 sizes never share. In
/// ascending order of what it is the first of, so that first[i] <= i.
std::vector<std::uint32_t> firstNearby(std::span<const ViewPoint> points, float size);

}  // namespace vlf
