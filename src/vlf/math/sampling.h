#pragma once
// Warps from the unit square, each with its density.

#include "vlf/math/vector.h"

#include <algorithm>

namespace vlf {

/// Cosine-weighted direction about +z. Density: cosineHemisphereDensity, per steradian.
inline Vec3 sampleCosineHemisphere(const Vec2& u) {
    const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1 - u.x))};
}
inline float cosineHemisphereDensity(float cosTheta) { return std::max(0.0f, cosTheta) / kPi; }

/// Uniform direction on the sphere; density 1 / 4π per steradian.
inline Vec3 sampleUniformSphere(const Vec2& u) {
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Barycentric coordinates (of the second and third vertex) of a uniform point in a triangle;
/// density 1 / area.
inline Vec2 sampleUniformTriangle(const Vec2& u) {
    const float s = std::sqrt(u.x);
    return {s * (1 - u.y), s * u.y};
}

/// Uniformly distributed rotation (Shoemake, "Uniform random rotations", Graphics Gems III, 1992).
inline Mat3 sampleUniformRotation(const Vec3& u) {
    const float a = std::sqrt(1 - u.x), b = std::sqrt(u.x);
    const float s = 2 * kPi * u.y, t = 2 * kPi * u.z;
    const float x = a * std::sin(s), y = a * std::cos(s), z = b * std::sin(t), w = b * std::cos(t);
    return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
            {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
            {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

}  // namespace vlf
