#include "vlf/dynamic/room_change.h"

#include "vlf/base/parallel.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr std::size_t kBlock = 4096;         // texels
constexpr std::size_t kGroupsPerBlock = 64;  // as many
constexpr int kSide = RoomTexels::kGroupSide, kHalf = kSide / 2;

/// Calls work(first, end) for parts of [0, count).
template <class Work>
void inBlocks(std::size_t count, Work work) {
    parallelFor((count + kBlock - 1) / kBlock, 1, [&](std::size_t block) {
        work(block * kBlock, std::min(count, (block + 1) * kBlock));
    });
}

/// Than zero.
float noLess(float light) {
    return light > 0 ? light : 0;
}
Vec3 noLess(const Vec3& light) {
    return {noLess(light.x), noLess(light.y), noLess(light.z)};
}

/// Numbers of a group's row.
void addRow(const float* own, const float* change, const float* start, const float* step, float v,
            float* __restrict sum) {
    for (int i = 0; i < 3 * kSide; ++i)
        sum[i] = noLess(own[i] + (change[i] + (start[i] + v * step[i])));
}

}  // namespace

/// Bilinear over the texels of a block, in texels from its first.
struct RoomChange::EvenChange {
    Vec3 start, alongU, alongV, both;

    /// Between four corners.
    EvenChange(const Vec3& c00, const Vec3& c10, const Vec3& c01, const Vec3& c11) {
        constexpr float kStep = 1.0f / kHalf;
        both = kStep * kStep * (c11 - c01 - c10 + c00);
        alongU = kStep * (c10 - c00) + 0.5f * both;
        alongV = kStep * (c01 - c00) + 0.5f * both;
        start = c00 + 0.5f * (alongU + alongV) - 0.25f * both;
    }

    Vec3 at(int u, int v) const {
        const auto x = static_cast<float>(u), y = static_cast<float>(v);
        return start + x * alongU + y * (alongV + x * both);
    }
};

RoomChange::RoomChange(const RoomTexels& room)
    : room_(room),
      change_(room.source.size(), Vec3(0)),
      touched_(room.source.size(), 0),
      groupTouched_(room.groups.size(), 0),
      blocks_(room.blockArea.size(), Vec3(0)),
      groups_(room.groups.size(), Vec3(0)) {
    for (std::uint32_t t = 0; t < room.source.size(); ++t)
        if (room.source[t] != kNoTexel && room.source[t] != t)
            followers_.emplace_back(t, room.source[t]);
}

void RoomChange::clear() {
    for (const std::uint32_t t : texels_)
        change_[t] = Vec3(0), touched_[t] = 0, groupTouched_[room_.groupOf[t]] = 0;
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
                         std::vector<Vec3>& corners) {
        corners.resize(lattice.corners.size());
        inBlocks(corners.size(), [&](std::size_t first, std::size_t end) {
            for (std::size_t c = first; c < end; ++c) {
                const TexelLattice::Corner& corner = lattice.corners[c];
                Vec3 sum(0);
                for (int k = 0; k < corner.count; ++k)
                    sum += corner.shares[k] * cells[corner.cells[k]];
                corners[c] = sum;
            }
        });
    };
    find(room_.blockLattice, blocks_, blockCorners_);
    find(room_.groupLattice, groups_, groupCorners_);
}

/// Of a group's blocks, by rows.
std::array<RoomChange::EvenChange, 4> RoomChange::evenChangeIn(std::uint32_t group) const {
    std::array<Vec3, 9> c;  // at the corners of the blocks, by rows
    const auto& ofGroup = room_.groupLattice.cornersOf[group];
    c[0] = all_ + groupCorners_[ofGroup[0]], c[2] = all_ + groupCorners_[ofGroup[1]];
    c[6] = all_ + groupCorners_[ofGroup[2]], c[8] = all_ + groupCorners_[ofGroup[3]];
    c[1] = 0.5f * (c[0] + c[2]), c[7] = 0.5f * (c[6] + c[8]);
    for (int i = 3; i < 6; ++i) c[i] = 0.5f * (c[i - 3] + c[i + 3]);
    const std::array<std::uint32_t, 4>* ofBlocks = &room_.blockLattice.cornersOf[4 * group];
    for (int i = 0; i < 9; ++i) {
        const int x = i % 3, y = i / 3, u = x / 2, v = y / 2;
        c[i] += blockCorners_[ofBlocks[2 * v + u][2 * (y - v) + x - u]];
    }
    return {EvenChange{c[0], c[1], c[3], c[4]}, EvenChange{c[1], c[2], c[4], c[5]},
            EvenChange{c[3], c[4], c[6], c[7]}, EvenChange{c[4], c[5], c[7], c[8]}};
}

/// Calls write(first, irradiance) for all covered texels, irradiance being `own` with the change of
/// one texel or of several in a row.
template <class Write>
void RoomChange::forTexels(const IrradianceAtlas& own, Write write) const {
    if (!everywhere_) {
        parallelFor(room_.unwrap.texels.size(), kBlock, [&](std::size_t i) {
            const std::uint32_t t = room_.unwrap.texels[i];
            write(t, std::array{noLess(own.irradiance[t] + change_[t])});
        });
        return;
    }
    parallelFor(room_.groups.size(), kGroupsPerBlock, [&](std::size_t g) {
        const TexelGroup& group = room_.groups[g];
        const auto even = evenChangeIn(static_cast<std::uint32_t>(g));
        if (group.count == kSide * kSide && group.open) return forRows(own, group, even, write);
        for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
            const std::uint32_t t = room_.unwrap.texels[room_.grouped[i]];
            const int u = room_.placeOf[t] % kSide, v = room_.placeOf[t] / kSide;
            Vec3 change = change_[t];
            if (!room_.hidden[t])
                change += even[v / kHalf * 2 + u / kHalf].at(u % kHalf, v % kHalf);
            write(t, std::array{noLess(own.irradiance[t] + change)});
        }
    });
}

/// Of a group that is covered whole: along columns of a block the change is linear.
template <class Write>
void RoomChange::forRows(const IrradianceAtlas& own, const TexelGroup& group,
                         const std::array<EvenChange, 4>& even, Write write) const {
    static constexpr std::array<float, 3 * kSide> kNone{};
    const bool varies = variesIn(room_.groupOf[group.corner]);
    for (int half = 0; half < 2; ++half) {
        std::array<Vec3, kSide> start, step;
        for (int u = 0; u < kSide; ++u) {
            const EvenChange& block = even[2 * half + u / kHalf];
            start[u] = block.at(u % kHalf, 0);
            step[u] = block.at(u % kHalf, 1) - start[u];
        }
        for (int v = 0; v < kHalf; ++v) {
            const std::uint32_t first = group.corner + (half * kHalf + v) * room_.unwrap.atlasWidth;
            std::array<Vec3, kSide> row;
            addRow(&own.irradiance[first].x, varies ? &change_[first].x : kNone.data(), &start[0].x,
                   &step[0].x, static_cast<float>(v), &row[0].x);
            write(first, row);
        }
    }
}

void RoomChange::findRadiance(const IrradianceAtlas& own, std::vector<Vec3>& radiance) {
    findCorners();
    forTexels(own, [&](std::uint32_t first, const auto& irradiance) {
        const float* reflectance = &room_.reflectance[first].x;
        const float* received = &irradiance[0].x;
        float* sent = &radiance[first].x;
        for (std::size_t k = 0; k < 3 * irradiance.size(); ++k)
            sent[k] = reflectance[k] * received[k] * (1 / kPi);
    });
}

void RoomChange::apply(const IrradianceAtlas& own, IrradianceAtlas& light) {
    if (empty() && !written_) return;
    written_ = !empty();
    findCorners();
    forTexels(own, [&](std::uint32_t first, const auto& irradiance) {
        std::copy(irradiance.begin(), irradiance.end(), light.irradiance.begin() + first);
    });
    inBlocks(followers_.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const auto [texel, source] = followers_[i];
            const Vec3 change = light.irradiance[source] - own.irradiance[source];
            light.irradiance[texel] = noLess(own.irradiance[texel] + change);
        }
    });
}

}  // namespace vlf
