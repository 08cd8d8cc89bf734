#pragma once
// Which triangles share a chart: coplanar neighbours of one material, and on curved surfaces
// neighbours whose normals stay within a cone, so that the group projects one-to-one on a plane.

#include "vlf/scene/scene.h"
#include "vlf/unwrap/texel_piece.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Triangles of one future chart. They project one-to-one along `axis`.
struct ChartGroup {
    std::vector<std::uint32_t> triangles;
    Vec3 axis;            ///< unit: area-weighted mean of the winding normals
    bool planar = false;  ///< all in one plane
};

/// Partitions the scene's triangles. `texelSize` (metres) is the resolution at which a group must
/// not overlap itself, `pieces` what is kept apart. Deterministic; groups are ordered by their
/// first triangle.
std::vector<ChartGroup> groupTriangles(const Scene& scene, float texelSize,
                                       const TexelPieces& pieces = {});

/// The group of every triangle.
std::vector<std::uint32_t> groupOfTriangles(const std::vector<ChartGroup>& groups,
                                            std::size_t triangles);

}  // namespace vlf
