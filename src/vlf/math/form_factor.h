#pragma once
// Form factor of a polygon (Lambert 1760).

#include "vlf/math/vector.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace detail {

/// Angle-weighted edge term of Lambert's formula for the edge from direction a to b (not unit).
inline float edgeFormFactor(const Vec3& a, const Vec3& b, const Vec3& n) {
    const Vec3 c = glm::cross(a, b);
    const float sine = glm::length(c), cosine = glm::dot(a, b);
    return sine > 0 ? std::atan2(sine, cosine) * glm::dot(n, c) / sine : 0;
}

}  // namespace detail

/// Form factor (in [0, 1]) from a differential area at `p` with unit normal `n` to triangle
/// (a, b, c), whichever side faces p; the part below the horizon of p is clipped. Unoccluded
/// irradiance from uniform radiance L is π L F.
inline float triangleFormFactor(const Vec3& p, const Vec3& n, const Vec3& a, const Vec3& b,
                                const Vec3& c) {
    const std::array<Vec3, 3> corner{a - p, b - p, c - p};
    std::array<Vec3, 4> clipped;
    int count = 0;
    for (int i = 0; i < 3; ++i) {  // Sutherland-Hodgman against the horizon
        const Vec3& u = corner[i];
        const Vec3& v = corner[(i + 1) % 3];
        const float hu = glm::dot(n, u), hv = glm::dot(n, v);
        if (hu >= 0) clipped[count++] = u;
        if ((hu > 0 && hv < 0) || (hu < 0 && hv > 0)) clipped[count++] = u + (v - u) * (hu / (hu - hv));
    }
    if (count < 3) return 0;
    float sum = 0;
    for (int i = 0; i < count; ++i)
        sum += detail::edgeFormFactor(clipped[i], clipped[(i + 1) % count], n);
    return std::min(1.0f, std::abs(sum) / (2 * kPi));
}

}  // namespace vlf
