#include "vlf/dynamic/room_change.h"

#include <utility>

namespace vlf {

RoomChange::RoomChange(const RoomTexels& room)
    : change_(room.source.size(), Vec3(0)),
      touched_(room.source.size(), 0),
      firstFollower_(room.source.size() + 1, 0) {
    const auto isFollower = [&](std::uint32_t t) {
        return room.source[t] != kNoTexel && room.source[t] != t;
    };
    for (std::uint32_t t = 0; t < room.source.size(); ++t)
        if (isFollower(t)) ++firstFollower_[room.source[t] + 1];
    for (std::size_t t = 0; t < room.source.size(); ++t) firstFollower_[t + 1] += firstFollower_[t];
    followers_.resize(firstFollower_.back());
    std::vector<std::uint32_t> next(firstFollower_.begin(), firstFollower_.end() - 1);
    for (std::uint32_t t = 0; t < room.source.size(); ++t)
        if (isFollower(t)) followers_[next[room.source[t]]++] = t;
}

void RoomChange::clear() {
    for (const std::uint32_t t : texels_) change_[t] = Vec3(0), touched_[t] = 0;
    texels_.clear();
}

void RoomChange::set(const RoomTexels& room, std::uint32_t texel, const Vec3& by,
                     const IrradianceAtlas& own, IrradianceAtlas& light,
                     std::vector<Vec3>& radiance) const {
    light.irradiance[texel] = glm::max(Vec3(0), own.irradiance[texel] + by);
    radiance[texel] = room.reflectance[texel] * light.irradiance[texel] / kPi;
    for (std::uint32_t f = firstFollower_[texel]; f < firstFollower_[texel + 1]; ++f) {
        const std::uint32_t t = followers_[f];
        light.irradiance[t] = glm::max(Vec3(0), own.irradiance[t] + by);
    }
}

void RoomChange::apply(const RoomTexels& room, const IrradianceAtlas& own, IrradianceAtlas& light,
                       std::vector<Vec3>& radiance) {
    for (const std::uint32_t t : written_)
        if (!touched_[t]) set(room, t, Vec3(0), own, light, radiance);
    for (const std::uint32_t t : texels_) set(room, t, change_[t], own, light, radiance);
    written_.assign(texels_.begin(), texels_.end());
}

}  // namespace vlf
