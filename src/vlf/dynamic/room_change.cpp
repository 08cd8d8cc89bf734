#include "vlf/dynamic/room_change.h"

#include "vlf/base/parallel.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr std::size_t kBlock = 4096;  // texels

/// Calls work(first, end) for parts of [0, count).
template <class Work>
void inBlocks(std::size_t count, Work work) {
    parallelFor((count + kBlock - 1) / kBlock, 1, [&](std::size_t block) {
        work(block * kBlock, std::min(count, (block + 1) * kBlock));
    });
}

}  // namespace

RoomChange::RoomChange(const RoomTexels& room)
    : room_(room),
      change_(room.source.size(), Vec3(0)),
      touched_(room.source.size(), 0),
      blocks_(room.blockArea.size(), Vec3(0)),
      groups_(room.groups.size(), Vec3(0)) {
    for (std::uint32_t t = 0; t < room.source.size(); ++t)
        if (room.source[t] != kNoTexel && room.source[t] != t)
            followers_.emplace_back(t, room.source[t]);
}

void RoomChange::clear() {
    for (const std::uint32_t t : texels_) change_[t] = Vec3(0), touched_[t] = 0;
    texels_.clear();
    if (everywhere_) {
        std::fill(blocks_.begin(), blocks_.end(), Vec3(0));
        std::fill(groups_.begin(), groups_.end(), Vec3(0));
    }
    all_ = Vec3(0);
    everywhere_ = false;
}

void RoomChange::findRadiance(const IrradianceAtlas& own, std::vector<Vec3>& radiance) const {
    const std::vector<std::uint32_t>& texels = room_.unwrap.texels;
    inBlocks(texels.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const std::uint32_t t = texels[i];
            radiance[t] = room_.reflectance[t] * glm::max(Vec3(0), own.irradiance[t] + of(t)) / kPi;
        }
    });
}

void RoomChange::apply(const IrradianceAtlas& own, IrradianceAtlas& light) {
    if (empty() && !written_) return;
    written_ = !empty();
    const std::vector<std::uint32_t>& texels = room_.unwrap.texels;
    inBlocks(texels.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i)
            light.irradiance[texels[i]] =
                glm::max(Vec3(0), own.irradiance[texels[i]] + of(texels[i]));
    });
    inBlocks(followers_.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const auto [texel, source] = followers_[i];
            light.irradiance[texel] = glm::max(Vec3(0), own.irradiance[texel] + of(source));
        }
    });
}

}  // namespace vlf
