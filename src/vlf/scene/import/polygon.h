#pragma once
// Triangulation of polygons.

#include "vlf/math/vector.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace vlf {

/// Most corners of a polygon that triangulatePolygon takes (its time grows with their square).
inline constexpr std::size_t kMaxPolygonCorners = 10000;

/// Twice-area vector of a polygon by Newell's method: its direction is the mean winding normal.
glm::dvec3 polygonAreaVector(std::span<const Vec3> corners);

/// Cuts a polygon, convex or concave, into corners.size() - 2 triangles of the same winding, by
/// ear clipping in the plane of its mean normal (Meisters 1975; ear status kept as in O'Rourke,
/// "Computational Geometry in C"). Each triangle holds three indices of corners. Polygons that
/// are not simple are cut too, without the promise that the area is kept.
/// Precondition: 3 <= corners.size() <= kMaxPolygonCorners.
std::vector<std::array<int, 3>> triangulatePolygon(std::span<const Vec3> corners);

}  // namespace vlf
