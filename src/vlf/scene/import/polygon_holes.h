#pragma once
// Triangulation of regions with holes.

#include "vlf/math/vector.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace vlf {

/// Closed lines in the plane, one after the other.
using Ring = std::vector<glm::dvec2>;

/// Whether no two edges meet but neighbours in their common corner.
bool areSimple(std::span<const Ring> rings);

/// Cuts the region on the left of simple rings (counter-clockwise ones around it, clockwise ones
/// around its holes) into counter-clockwise triangles: indices of corners, counted through all
/// rings. Holes are joined to what surrounds them by bridges, then ears are clipped (polygon.h);
/// triangles without area may be missing. Nothing if rounding spoils it or a part has more than
/// kMaxRegionCorners corners. Corners should be exact in single precision.
std::optional<std::vector<std::array<int, 3>>> triangulateRegion(std::span<const Ring> rings);

inline constexpr std::size_t kMaxRegionCorners = 4000;

}  // namespace vlf
