#include "vlf/dynamic/near_place.h"

namespace vlf {

/// A parallel that starts o beside the ray, in the world, meets the plane at o - ω (n·o) / (n·ω)
/// from where that does.
NearPlace::NearPlace(const Chart& chart, const Ray& ray, const Vec3& place, const Pose& pose)
    : chart_(&chart), at_(chart.texelCoordinates(place)) {
    const Vec3 slope = chart.normal / glm::dot(chart.normal, ray.direction);
    const auto along = [&](const Vec3& axis) {
        return pose.scale * pose.inverseDirection(axis - glm::dot(axis, ray.direction) * slope);
    };
    alongU_ = along(chart.uAxis);
    alongV_ = along(chart.vAxis);
}

std::optional<NearPlace> NearPlace::of(const Ray& ray, float distance, std::uint32_t texel,
                                       const Pose& pose, const RoomTexels& room) {
    const Chart& chart = room.unwrap.charts[room.unwrap.texelChart[room.entryOf[texel]]];
    if (!chart.planar) return std::nullopt;
    return NearPlace(chart, ray, ray.origin + distance * ray.direction, pose);
}

std::uint32_t NearPlace::texelFrom(const Vec3& offset, const RoomTexels& room) const {
    const Vec2 at = at_ + Vec2(glm::dot(alongU_, offset), glm::dot(alongV_, offset));
    if (!(at.x >= 0 && at.y >= 0 && at.x < static_cast<float>(chart_->width) &&
          at.y < static_cast<float>(chart_->height)))
        return kNoTexel;
    const std::uint32_t texel =
        (chart_->y + static_cast<std::uint32_t>(at.y)) * room.unwrap.atlasWidth + chart_->x +
        static_cast<std::uint32_t>(at.x);
    return room.excluded[texel] || room.source[texel] != texel ? kNoTexel : texel;
}

}  // namespace vlf
