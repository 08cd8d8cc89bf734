#include "vlf/field/radiance_field.h"

#include <algorithm>
#include <bit>

namespace vlf {

std::span<const TileRow> RadianceField::rowsOf(std::uint32_t direction, std::uint32_t chart) const {
    const auto all = rowsOf(direction);
    const auto first =
        std::lower_bound(all.begin(), all.end(), chart,
                         [](const TileRow& row, std::uint32_t c) { return row.chart < c; });
    auto last = first;
    while (last != all.end() && last->chart == chart) ++last;
    return {first, last};
}

std::uint64_t RadianceField::index(std::span<const TileRow> rowsOfChart, int x, int y) const {
    const int shift = std::countr_zero(static_cast<unsigned>(tileSize)), mask = tileSize - 1;
    if (rowsOfChart.empty() || x < 0 || y < 0) return kNoElement;
    const int r = (y >> shift) - rowsOfChart.front().tileY;
    if (r < 0 || r >= static_cast<int>(rowsOfChart.size())) return kNoElement;
    const TileRow& row = rowsOfChart[static_cast<std::size_t>(r)];
    const int tile = (x >> shift) - row.tileX;
    if (tile < 0 || tile >= row.tilesWide) return kNoElement;
    return row.firstElement + (static_cast<std::uint64_t>(tile) << 2 * shift) +
           static_cast<std::uint64_t>((y & mask) << shift | (x & mask));
}

namespace {

/// 2^exponent, exponent in [-126, 127].
float powerOfTwo(int exponent) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

/// ⌊log₂ v⌋ of a positive normal number.
int floorLog2(float v) {
    return static_cast<int>(std::bit_cast<std::uint32_t>(v) >> 23) - 127;
}

std::uint32_t roundToNearest(double v) {
    return static_cast<std::uint32_t>(v + 0.5);
}

}  // namespace

std::uint32_t packRgb9e5(const Vec3& rgb) {
    constexpr float kMax = 65408.0f;  // (2⁹-1)/2⁹ · 2¹⁶
    const auto clamped = [&](float v) { return std::min(std::max(0.0f, v), kMax); };
    const Vec3 c(clamped(rgb.x), clamped(rgb.y), clamped(rgb.z));
    const float largest = std::max(c.x, std::max(c.y, c.z));
    int exponent = std::max(-16, floorLog2(largest)) + 16;
    if (roundToNearest(largest * powerOfTwo(24 - exponent)) > 511) ++exponent;
    const float scale = powerOfTwo(24 - exponent);
    return roundToNearest(c.x * scale) | roundToNearest(c.y * scale) << 9 |
           roundToNearest(c.z * scale) << 18 | static_cast<std::uint32_t>(exponent) << 27;
}

Vec3 unpackRgb9e5(std::uint32_t packed) {
    const float scale = powerOfTwo(static_cast<int>(packed >> 27) - 24);
    return scale * Vec3(packed & 511, packed >> 9 & 511, packed >> 18 & 511);
}

}  // namespace vlf
