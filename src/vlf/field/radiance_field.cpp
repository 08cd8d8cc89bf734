#include "vlf/field/radiance_field.h"

#include <algorithm>
#include <bit>

namespace vlf {

const TileBlock* RadianceField::find(std::uint32_t direction, std::uint32_t chart) const {
    const auto range = blocksOf(direction);
    const auto it =
        std::lower_bound(range.begin(), range.end(), chart,
                         [](const TileBlock& block, std::uint32_t c) { return block.chart < c; });
    return it != range.end() && it->chart == chart ? &*it : nullptr;
}

std::uint64_t RadianceField::index(const TileBlock& block, int x, int y) const {
    const int m = tileSize;
    const int column = x - block.tileX * m, row = y - block.tileY * m;
    const std::uint64_t tile = static_cast<std::uint64_t>(row / m) * block.tilesWide + column / m;
    return block.firstElement + tile * m * m + (row % m) * m + column % m;
}

const RadianceElement* RadianceField::element(const TileBlock& block, int x, int y) const {
    const int m = tileSize;
    const int column = x - block.tileX * m, row = y - block.tileY * m;
    if (column < 0 || row < 0 || column >= block.tilesWide * m || row >= block.tilesHigh * m)
        return nullptr;
    return &elements[index(block, x, y)];
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

std::uint32_t roundToNearest(double v) { return static_cast<std::uint32_t>(v + 0.5); }

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
