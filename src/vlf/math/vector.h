#pragma once
// Vector types (glm) under the names used throughout.

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <numbers>

namespace vlf {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;

inline constexpr float kPi = std::numbers::pi_v<float>;

inline bool isFinite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline float maxComponent(const Vec3& v) { return std::fmax(v.x, std::fmax(v.y, v.z)); }

/// Luminance of linear sRGB (Rec. 709 primaries): Y of CIE XYZ.
inline float luminance(const Vec3& rgb) {
    return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

}  // namespace vlf
