#include "vlf/propagate/shared_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vlf {

namespace {

constexpr float kNormalStep = 0.25f;

using Key = std::array<std::int32_t, 6>;

/// The cube is centred on the first point, so that small charts lie within one.
Key keyOf(const ViewPoint& point, const ViewPoint& first, float size) {
    Key key{};
    for (int i = 0; i < 3; ++i) {
        key[i] =
            static_cast<std::int32_t>(std::round((point.position[i] - first.position[i]) / size));
        key[3 + i] = static_cast<std::int32_t>(
            std::round((point.normal[i] - first.normal[i]) / kNormalStep));
    }
    return key;
}

}  // namespace

std::vector<std::uint32_t> firstNearby(std::span<const ViewPoint> points, float size) {
    std::vector<std::pair<Key, std::uint32_t>> sorted;
    sorted.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        sorted.emplace_back(keyOf(points[i], points.front(), size), i);
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> first(points.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const bool begins = i == 0 || sorted[i].first != sorted[i - 1].first;
        first[sorted[i].second] = begins ? sorted[i].second : first[sorted[i - 1].second];
    }
    return first;
}

}  // namespace vlf
