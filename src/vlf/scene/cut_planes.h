#pragma once
// Cuts a scene's triangles along planes perpendicular to the axes: the same surface in more
// triangles, without gaps, since triangles that share an edge are cut at the same points.

#include "vlf/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf {

/// Coordinates of planes along x, y and z, metres, ascending.
using AxisPlanes = std::array<std::vector<float>, 3>;

/// Cuts the triangles of `divided` (by triangle) and all that are connected with them by vertices
/// at the same place, but for emitters: a lamp is sampled best as it is. Vertices closer to a plane
/// than `tolerance` (metres) lie on it, so that no slivers arise. Meshes, materials, shading
/// normals and texture coordinates stay what they are. Returns, for every triangle of the scene
/// that results, the one that it was cut from.
std::vector<std::uint32_t> cutByPlanes(Scene& scene, const AxisPlanes& planes, float tolerance,
                                       const std::vector<bool>& divided);

}  // namespace vlf
