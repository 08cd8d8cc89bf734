#pragma once
// Light that changes evenly over a square of texels, or over a quarter of it, found at some of
// them.

#include "vlf/dynamic/room_texels.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>

namespace vlf {

/// What is known beforehand of light on some texels.
enum class LightThere {
    none,
    even,  ///< it changes no more than once between one end of them and the other
    any,
};

/// The texels of one square, or of what a chart has of it at its edge.
class TexelSquare {
  public:
    TexelSquare(const RoomTexels& room, const TexelGroup& group)
        : room_(room), bounds_(group.bounds) {
        entries_.fill(kNoTexel);
        int width = 0, height = 0;
        for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
            const std::uint32_t entry = room.grouped[i];
            const int place = room.placeOf[room.unwrap.texels[entry]];
            entries_[place] = entry;
            width = std::max(width, place % kSide + 1);
            height = std::max(height, place / kSide + 1);
        }
        atX_ = {0, (width - 1) / 2, width - 1};
        atY_ = {0, (height - 1) / 2, height - 1};
    }

    /// Calls find(entry) for as many texels as needed and keep(texel, irradiance) for all that may
    /// have light, by expect(bounds of some texels). Deviations of less than `slight` (luminance,
    /// W·m⁻²) do not matter.
    template <class Expect, class Find, class Keep>
    void light(float slight, Expect expect, Find find, Keep keep) {
        const auto at = [&](int x, int y) {
            const int place = kSide * y + x;
            if (!known_[place]) known_[place] = true, light_[place] = find(entries_[place]);
            return light_[place];
        };
        const bool even = hasNodes() && expect(bounds_) == LightThere::even && isEven(slight, at);
        for (int number = 0; number < 4; ++number) {
            const Quarter quarter = quarterOf(number);
            const LightThere there = even ? LightThere::even : expect(boundsOf(quarter));
            if (there == LightThere::none) continue;
            const bool straight = even || (there == LightThere::even && hasNodes(quarter) &&
                                           isEven(quarter, slight, at));
            for (int y = quarter.y0; y < quarter.endY; ++y)
                for (int x = quarter.x0; x < quarter.endX; ++x)
                    if (const std::uint32_t entry = entries_[kSide * y + x]; entry != kNoTexel)
                        keep(room_.unwrap.texels[entry], straight && !known_[kSide * y + x]
                                                             ? interpolate(quarter, x, y, at)
                                                             : at(x, y));
        }
    }

  private:
    static constexpr float kEven =
        0.03f;  // relative deviation of the middle from its interpolation
    static constexpr int kSide = RoomTexels::kGroupSide;

    /// The texels between four at its corners, those at the near sides among them, and at the far
    /// ones if they are the square's.
    struct Quarter {
        int x0, y0, x1, y1, endX, endY;
    };

    Quarter quarterOf(int number) const {
        const int i = number % 2, j = number / 2;
        return {atX_[i], atY_[j], atX_[i + 1], atY_[j + 1], atX_[i + 1] + i, atY_[j + 1] + j};
    }

    bool has(int x, int y) const { return entries_[kSide * y + x] != kNoTexel; }

    /// Whether its corners and its middle are surface.
    bool hasNodes(const Quarter& q) const {
        return has(q.x0, q.y0) && has(q.x1, q.y0) && has(q.x0, q.y1) && has(q.x1, q.y1) &&
               has((q.x0 + q.x1) / 2, (q.y0 + q.y1) / 2);
    }
    bool hasNodes() const {
        return std::ranges::all_of(atY_, [&](int y) {
            return std::ranges::all_of(atX_, [&](int x) { return has(x, y); });
        });
    }

    Sphere boundsOf(const Quarter& q) const {
        Bounds bounds;
        float texel = 0;
        for (int y = q.y0; y <= q.y1; ++y)
            for (int x = q.x0; x <= q.x1; ++x) {
                const std::uint32_t entry = entries_[kSide * y + x];
                if (entry == kNoTexel) continue;
                bounds.add(room_.place[room_.unwrap.texels[entry]]);
                texel = room_.unwrap.charts[room_.unwrap.texelChart[entry]].texelSize();
            }
        return {bounds.centre(), 0.5f * glm::length(bounds.size()) + texel};
    }

    static bool isNear(const Vec3& found, const Vec3& straight, float slight) {
        const float a = luminance(found), b = luminance(straight);
        return std::abs(a - b) <= std::max(slight, kEven * std::max(a, b));
    }

    /// Along all lines between the nine texels of the quarters.
    template <class At>
    bool isEven(float slight, At& at) const {
        const float u = share(0, atX_[1], atX_[2]), v = share(0, atY_[1], atY_[2]);
        for (int k = 0; k < 3; ++k) {
            const int x = atX_[k], y = atY_[k];
            if (!isNear(at(atX_[1], y), glm::mix(at(0, y), at(atX_[2], y), u), slight) ||
                !isNear(at(x, atY_[1]), glm::mix(at(x, 0), at(x, atY_[2]), v), slight))
                return false;
        }
        return true;
    }

    template <class At>
    bool isEven(const Quarter& q, float slight, At& at) const {
        const int x = (q.x0 + q.x1) / 2, y = (q.y0 + q.y1) / 2;
        return isNear(at(x, y), interpolate(q, x, y, at), slight);
    }

    static float share(int a, int x, int b) {
        return a == b ? 0 : static_cast<float>(x - a) / static_cast<float>(b - a);
    }

    template <class At>
    static Vec3 interpolate(const Quarter& q, int x, int y, At& at) {
        const float u = share(q.x0, x, q.x1), v = share(q.y0, y, q.y1);
        return glm::mix(glm::mix(at(q.x0, q.y0), at(q.x1, q.y0), u),
                        glm::mix(at(q.x0, q.y1), at(q.x1, q.y1), u), v);
    }

    const RoomTexels& room_;
    Sphere bounds_;
    std::array<std::uint32_t, kSide * kSide> entries_;
    std::array<int, 3> atX_{}, atY_{};
    std::array<Vec3, kSide * kSide> light_;
    std::bitset<kSide * kSide> known_;
};

}  // namespace vlf
