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

void RoomChange::findCorners() {
    if (!everywhere_) return;
    const auto find = [](const TexelLattice& lattice, const std::vector<Vec3>& cells,
                         Corners& corners) {
        corners.resize(cells.size());
        for (std::size_t c = 0; c < cells.size(); ++c)
            for (std::size_t k = 0; k < 4; ++k) {
                Vec3 sum(0);
                float count = 0;
                for (const std::uint32_t cell : lattice.around[c][k])
                    if (cell != TexelLattice::kNone) sum += cells[cell], ++count;
                corners[c][k] = sum / count;
            }
    };
    find(room_.blockLattice, blocks_, blockCorners_);
    find(room_.groupLattice, groups_, groupCorners_);
}

Vec3 RoomChange::smoothChangeOf(std::uint32_t texel) const {
    if (!everywhere_) return change_[texel];
    const auto between = [](const std::array<Vec3, 4>& corner, float u, float v) {
        return (1 - v) * ((1 - u) * corner[0] + u * corner[1]) +
               v * ((1 - u) * corner[2] + u * corner[3]);
    };
    constexpr int kSide = RoomTexels::kGroupSide, kHalf = kSide / 2;
    const int u = room_.placeOf[texel] & 7, v = room_.placeOf[texel] >> 3;
    const std::uint32_t block = room_.blockOf[texel];
    return change_[texel] + all_ +
           between(groupCorners_[block / 4], (u + 0.5f) / kSide, (v + 0.5f) / kSide) +
           between(blockCorners_[block], (u % kHalf + 0.5f) / kHalf, (v % kHalf + 0.5f) / kHalf);
}

void RoomChange::findRadiance(const IrradianceAtlas& own, std::vector<Vec3>& radiance) {
    findCorners();
    const std::vector<std::uint32_t>& texels = room_.unwrap.texels;
    inBlocks(texels.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const std::uint32_t t = texels[i];
            radiance[t] = room_.reflectance[t] *
                          glm::max(Vec3(0), own.irradiance[t] + smoothChangeOf(t)) / kPi;
        }
    });
}

void RoomChange::apply(const IrradianceAtlas& own, IrradianceAtlas& light) {
    if (empty() && !written_) return;
    written_ = !empty();
    findCorners();
    const std::vector<std::uint32_t>& texels = room_.unwrap.texels;
    inBlocks(texels.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i)
            light.irradiance[texels[i]] =
                glm::max(Vec3(0), own.irradiance[texels[i]] + smoothChangeOf(texels[i]));
    });
    inBlocks(followers_.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const auto [texel, source] = followers_[i];
            light.irradiance[texel] =
                glm::max(Vec3(0), own.irradiance[texel] + smoothChangeOf(source));
        }
    });
}

}  // namespace vlf
