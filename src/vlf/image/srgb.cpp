#include "vlf/image/srgb.h"

#include <array>
#include <cmath>

namespace vlf {

namespace {

std::array<float, 256> makeDecodeTable() {
    std::array<float, 256> table{};
    for (int i = 0; i < 256; ++i) table[i] = linearFromSrgb(static_cast<float>(i) / 255);
    return table;
}

}  // namespace

float srgbFromLinear(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

Vec3 srgbFromLinear(const Vec3& linear) {
    return {srgbFromLinear(linear.x), srgbFromLinear(linear.y), srgbFromLinear(linear.z)};
}

float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Vec3 linearFromSrgb(const Vec3& encoded) {
    return {linearFromSrgb(encoded.x), linearFromSrgb(encoded.y), linearFromSrgb(encoded.z)};
}

std::uint8_t srgb8FromLinear(float linear) {
    return static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(linear)));
}

float linearFromSrgb8(std::uint8_t encoded) {
    static const std::array<float, 256> table = makeDecodeTable();
    return table[encoded];
}

}  // namespace vlf
