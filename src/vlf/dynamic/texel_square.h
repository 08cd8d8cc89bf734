#pragma once
// Light that changes evenly over a square of texels, found at nine of them.

#include "vlf/dynamic/room_texels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

/// The texels of one square.
class TexelSquare {
  public:
    TexelSquare(const RoomTexels& room, const TexelGroup& group) : room_(room) {
        entries_.fill(kNoTexel);
        for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
            const std::uint32_t entry = room.grouped[i];
            const Chart& chart = room.unwrap.charts[room.unwrap.texelChart[entry]];
            const std::uint32_t texel = room.unwrap.texels[entry];
            const std::uint32_t x = texel % room.unwrap.atlasWidth - chart.x;
            const std::uint32_t y = texel / room.unwrap.atlasWidth - chart.y;
            entries_[y % kSide * kSide + x % kSide] = entry;
        }
        whole_ = group.count == kSide * kSide;
    }

    /// Calls find(entry) for as many texels as needed and keep(texel, irradiance) for all.
    /// Deviations of less than `slight` (luminance, W·m⁻²) do not matter.
    template <class Find, class Keep>
    void light(float slight, Find find, Keep keep) const {
        if (whole_) {
            std::array<Vec3, 9> grid;
            for (int i = 0; i < 9; ++i) grid[i] = find(entryAt(kAt[i % 3], kAt[i / 3]));
            const bool even = isEven(grid, slight);
            for (int quarter = 0; quarter < 4; ++quarter)
                lightQuarter(grid, quarter, even, slight, find, keep);
            return;
        }
        for (const std::uint32_t entry : entries_)
            if (entry != kNoTexel) keep(room_.unwrap.texels[entry], find(entry));
    }

  private:
    static constexpr float kEven =
        0.03f;  // relative deviation of the middle from its interpolation
    static constexpr int kSide = RoomTexels::kGroupSide;
    static constexpr std::array<int, 3> kAt{0, 3, 7};
    static constexpr std::array<int, 2> kMiddle{1, 5};

    std::uint32_t entryAt(int x, int y) const { return entries_[y * kSide + x]; }

    /// Of the texels between four of the nine; by themselves if one in the middle deviates.
    template <class Find, class Keep>
    void lightQuarter(const std::array<Vec3, 9>& grid, int quarter, bool even, float slight,
                      Find& find, Keep& keep) const {
        const int i = quarter % 2, j = quarter / 2;
        const int endX = i == 0 ? kAt[1] : kSide, endY = j == 0 ? kAt[1] : kSide;
        const int middleX = kMiddle[i], middleY = kMiddle[j];
        const auto isNode = [&](int x, int y) {
            return (x == kAt[i] || x == kAt[i + 1]) && (y == kAt[j] || y == kAt[j + 1]);
        };
        Vec3 middle(0);
        if (!even) {
            middle = find(entryAt(middleX, middleY));
            const float straight = luminance(interpolate(grid, i, j, middleX, middleY));
            even = std::abs(luminance(middle) - straight) <=
                   std::max(slight, kEven * std::max(luminance(middle), straight));
        }
        for (int y = kAt[j]; y < endY; ++y)
            for (int x = kAt[i]; x < endX; ++x) {
                const std::uint32_t entry = entryAt(x, y);
                keep(room_.unwrap.texels[entry], even || isNode(x, y)
                                                     ? interpolate(grid, i, j, x, y)
                                                 : x == middleX && y == middleY ? middle
                                                                                : find(entry));
            }
    }

    static Vec3 interpolate(const std::array<Vec3, 9>& grid, int i, int j, int x, int y) {
        const float u = static_cast<float>(x - kAt[i]) / static_cast<float>(kAt[i + 1] - kAt[i]);
        const float v = static_cast<float>(y - kAt[j]) / static_cast<float>(kAt[j + 1] - kAt[j]);
        const auto row = [&](int r) { return (1 - u) * grid[3 * r + i] + u * grid[3 * r + i + 1]; };
        return (1 - v) * row(j) + v * row(j + 1);
    }

    static bool isEven(const std::array<Vec3, 9>& grid, float slight) {
        const auto at = [&](int i) { return luminance(grid[i]); };
        const float u = static_cast<float>(kAt[1]) / kAt[2];
        const auto even = [&](int a, int middle, int b) {
            const float straight = (1 - u) * at(a) + u * at(b);
            return std::abs(at(middle) - straight) <=
                   std::max(slight, kEven * std::max(at(middle), straight));
        };
        return even(0, 1, 2) && even(3, 4, 5) && even(6, 7, 8) && even(0, 3, 6) && even(1, 4, 7) &&
               even(2, 5, 8);
    }

    const RoomTexels& room_;
    std::array<std::uint32_t, kSide * kSide> entries_;
    bool whole_ = false;
};

}  // namespace vlf
