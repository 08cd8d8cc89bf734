#pragma once
// Unit vectors in four bytes.

#include "vlf/math/vector.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace vlf {

/// The octahedron's coordinates, as 32767ths; shaders/octahedron.glsl reads them.
inline std::array<std::int16_t, 2> toOctahedron(const Vec3& n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    Vec2 e = Vec2(n) / (sum > 0 ? sum : 1);
    if (n.z < 0)
        e = Vec2((1 - std::abs(e.y)) * (e.x < 0 ? -1.0f : 1.0f),
                 (1 - std::abs(e.x)) * (e.y < 0 ? -1.0f : 1.0f));
    const auto code = [](float v) { return static_cast<std::int16_t>(std::lround(v * 32767)); };
    return {code(e.x), code(e.y)};
}

}  // namespace vlf
