#pragma once
// How large texels are: evenly spent over the scene's area, and finer where a diffuse surface
// bends, for irradiance there changes with the normal.

#include "vlf/scene/scene.h"

#include <cstdint>
#include <span>

namespace vlf {

/// Texels of bent surfaces are at most this many times finer than those of flat ones.
inline constexpr float kFinestBend = 4;

/// Texel size (metres) for a set of triangles where flat surfaces have `flatSize`: such that the
/// shading normal turns by no more than about 6 degrees (root mean square) from texel to texel, but
/// not below flatSize / kFinestBend. From the curvature of the interpolated shading normals.
float texelSizeOf(const Scene& scene, std::span<const std::uint32_t> triangles, float flatSize);

/// About how many texels the fronts of the scene take.
double texelsNeeded(const Scene& scene, float flatSize);

/// Size of flat surfaces' texels (metres) that spends about `budget` texels on the scene's fronts.
float texelSizeForBudget(const Scene& scene, double budget);

}  // namespace vlf
