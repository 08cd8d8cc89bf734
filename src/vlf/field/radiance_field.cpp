#include "vlf/field/radiance_field.h"

#include <algorithm>
#include <cmath>

namespace vlf {

const TileBlock* RadianceField::find(std::uint32_t direction, std::uint32_t chart) const {
    const auto range = blocksOf(direction);
    const auto it = std::lower_bound(
        range.begin(), range.end(), chart,
        [](const TileBlock& block, std::uint32_t c) { return block.chart < c; });
    return it != range.end() && it->chart == chart ? &*it : nullptr;
}

const RadianceElement* RadianceField::element(const TileBlock& block, int x, int y) const {
    const int m = tileSize;
    const int column = x - block.tileX * m, row = y - block.tileY * m;
    if (column < 0 || row < 0 || column >= block.tilesWide * m || row >= block.tilesHigh * m)
        return nullptr;
    const std::uint64_t tile =
        static_cast<std::uint64_t>(row / m) * block.tilesWide + column / m;
    return &elements[block.firstElement + tile * m * m + (row % m) * m + column % m];
}

std::uint32_t packRgb9e5(const Vec3& rgb) {
    constexpr float kMax = 65408.0f;  // (2⁹-1)/2⁹ · 2¹⁶
    const Vec3 c = glm::clamp(rgb, Vec3(0), Vec3(kMax));
    const float largest = maxComponent(c);
    int exponent = largest > 0 ? std::max(-16, std::ilogb(largest)) + 16 : 0;
    if (std::lround(std::ldexp(largest, 24 - exponent)) > 511) ++exponent;
    const auto mantissa = [&](float v) {
        return static_cast<std::uint32_t>(std::lround(std::ldexp(v, 24 - exponent)));
    };
    return mantissa(c.x) | mantissa(c.y) << 9 | mantissa(c.z) << 18 |
           static_cast<std::uint32_t>(exponent) << 27;
}

Vec3 unpackRgb9e5(std::uint32_t packed) {
    const float scale = std::ldexp(1.0f, static_cast<int>(packed >> 27) - 24);
    return scale * Vec3(packed & 511, packed >> 9 & 511, packed >> 18 & 511);
}

}  // namespace vlf
