#pragma once
// The transfer function of sRGB, IEC 61966-2-1.

#include "vlf/math/vector.h"

#include <cstdint>

namespace vlf {

/// Encoded value in [0, 1] of a linear value; clamps, and NaN becomes 0.
float srgbFromLinear(float linear);
Vec3 srgbFromLinear(const Vec3& linear);

/// Linear value in [0, 1] of an encoded one in [0, 1].
float linearFromSrgb(float encoded);
Vec3 linearFromSrgb(const Vec3& encoded);

/// 8-bit encoded value of a linear one, as srgbFromLinear.
std::uint8_t srgb8FromLinear(float linear);

/// Linear value of an 8-bit encoded one, by table.
float linearFromSrgb8(std::uint8_t encoded);

}  // namespace vlf
