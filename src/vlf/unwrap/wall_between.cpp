#include "vlf/unwrap/wall_between.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr float kLift = 0.01f;  // height, in texels, at which the points look for each other

}  // namespace

bool wallBetween(const RayScene& rays, const Chart& chart, const Vec3& p, const Vec3& q) {
    const Vec3 lift = std::max(2 * rays.epsilon(), kLift * chart.texelSize()) * chart.normal;
    return rays.occluded({p + lift, q - p, 0, 1});
}

}  // namespace vlf
