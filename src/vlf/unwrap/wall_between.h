#pragma once
// Walls that stand on a surface.

#include "vlf/field/chart.h"
#include "vlf/trace/ray_scene.h"

namespace vlf {

/// Whether something stands between two points of a planar chart's surface: they do not see each
/// other along it.
bool wallBetween(const RayScene& rays, const Chart& chart, const Vec3& p, const Vec3& q);

}  // namespace vlf
