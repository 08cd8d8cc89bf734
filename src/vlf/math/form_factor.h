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

struct Polygon {
    std::array<Vec3, 5> corner;
    int count = 0;
};

/// The part on the positive side of the plane through the origin with normal n
/// (Sutherland-Hodgman).
inline Polygon clip(const Polygon& polygon, const Vec3& n) {
    Polygon clipped;
    for (int i = 0; i < polygon.count; ++i) {
        const Vec3& u = polygon.corner[i];
        const Vec3& v = polygon.corner[(i + 1) % polygon.count];
        const float hu = glm::dot(n, u), hv = glm::dot(n, v);
        if (hu >= 0) clipped.corner[clipped.count++] = u;
        if ((hu > 0 && hv < 0) || (hu < 0 && hv > 0))
            clipped.corner[clipped.count++] = u + (v - u) * (hu / (hu - hv));
    }
    return clipped;
}

}  // namespace detail

/// Form factor (in [0, 1]) from a differential area at `p` with unit normal `n` to triangle
/// (a, b, c), whichever side faces p; the parts below the horizons of n and of `surface`, the
/// normal of the surface there, are clipped. Unoccluded irradiance from uniform radiance L is π L
/// F.
inline float triangleFormFactor(const Vec3& p, const Vec3& n, const Vec3& surface, const Vec3& a,
                                const Vec3& b, const Vec3& c) {
    detail::Polygon polygon = detail::clip({{a - p, b - p, c - p}, 3}, n);
    if (surface != n) polygon = detail::clip(polygon, surface);
    if (polygon.count < 3) return 0;
    float sum = 0;
    for (int i = 0; i < polygon.count; ++i)
        sum +=
            detail::edgeFormFactor(polygon.corner[i], polygon.corner[(i + 1) % polygon.count], n);
    return std::min(1.0f, std::abs(sum) / (2 * kPi));
}

/// The same where n is the surface's normal.
inline float triangleFormFactor(const Vec3& p, const Vec3& n, const Vec3& a, const Vec3& b,
                                const Vec3& c) {
    return triangleFormFactor(p, n, n, a, b, c);
}

}  // namespace vlf
