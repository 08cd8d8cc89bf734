#pragma once
// Reflection by a rough surface: microscopic mirrors whose normals follow the GGX distribution of
// width α in (0, 1], isotropic, with Smith's masking, once for either direction
// (B. Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007). Light
// that bounces between the facets more than once is absorbed. Directions are unit, in a frame whose
// z is the surface's normal, and point away from it.

#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/vector.h"

#include <algorithm>

namespace vlf {

/// Density of facet normals, per steradian (D).
inline float ggxNormals(float alpha, const Vec3& h) {
    if (h.z <= 0) return 0;
    const float a2 = alpha * alpha;
    const float s = a2 * h.z * h.z + h.x * h.x + h.y * h.y;
    return a2 / (kPi * s * s);
}

/// The share of the facets that face w which is seen along it (Smith's G1); 0 below the surface.
inline float ggxVisible(float alpha, const Vec3& w) {
    if (w.z <= 0) return 0;
    const float tangent2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return 2 / (1 + std::sqrt(1 + alpha * alpha * tangent2));
}

/// Density with which reflection of a ray towards `toEye` about a visible facet gives `direction`,
/// per steradian.
inline float ggxDensity(float alpha, const Vec3& toEye, const Vec3& direction) {
    if (toEye.z <= 0) return 0;
    const Vec3 h = glm::normalize(toEye + direction);
    return ggxNormals(alpha, h) * ggxVisible(alpha, toEye) / (4 * toEye.z);
}

/// BRDF times cosine of `direction`, of facets that reflect all light, sr⁻¹.
inline float ggxLobe(float alpha, const Vec3& toEye, const Vec3& direction) {
    if (direction.z <= 0) return 0;
    return ggxDensity(alpha, toEye, direction) * ggxVisible(alpha, direction);
}

/// Normal of a facet that is seen from `toEye` (E. Heitz, "Sampling the GGX distribution of visible
/// normals", JCGT 7(4), 2018). Precondition: toEye.z > 0.
inline Vec3 sampleGgxNormal(float alpha, const Vec3& toEye, const Vec2& u) {
    const Vec3 v = glm::normalize(Vec3(alpha * toEye.x, alpha * toEye.y, toEye.z));
    const float length2 = v.x * v.x + v.y * v.y;
    const Vec3 t1 = length2 > 1e-12f ? Vec3(-v.y, v.x, 0) / std::sqrt(length2) : Vec3(1, 0, 0);
    const Vec3 t2 = glm::cross(v, t1);
    const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
    const float x = r * std::cos(phi);
    const float share = 0.5f * (1 + v.z);
    const float y = (1 - share) * std::sqrt(std::max(0.0f, 1 - x * x)) + share * r * std::sin(phi);
    const Vec3 h = x * t1 + y * t2 + std::sqrt(std::max(0.0f, 1 - x * x - y * y)) * v;
    return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(1e-6f, h.z)));
}

/// A reflection of a ray, in the world.
struct GlossyReflection {
    Vec3 direction{0};
    float weight = 0;  ///< lobe by density, at most 1; 0: the ray ends in the surface
};

/// Samples the reflection of a ray that arrives along `incoming` at a surface with this normal
/// (dot(incoming, normal) < 0); density: ggxDensity.
inline GlossyReflection sampleGgxReflection(float alpha, const Vec3& incoming, const Vec3& normal,
                                            const Vec2& u) {
    const Frame frame = frameFromNormal(normal);
    Vec3 toEye = frame.toLocal(-incoming);
    toEye.z = std::max(toEye.z, 1e-4f);
    const Vec3 facet = sampleGgxNormal(alpha, toEye, u);
    const Vec3 reflected = glm::reflect(-toEye, facet);
    return {frame.toWorld(reflected), ggxVisible(alpha, reflected)};
}

/// The share of light that facets which reflect all of it send on, out of a ray with this cosine;
/// by quadrature.
inline float ggxAlbedo(float alpha, float cosine) {
    constexpr int kPoints = 256;
    const float c = std::clamp(cosine, 1e-3f, 1.0f);
    const Vec3 toEye(std::sqrt(1 - c * c), 0, c);
    float sum = 0;
    for (int i = 0; i < kPoints; ++i)
        sum += ggxVisible(
            alpha, glm::reflect(-toEye, sampleGgxNormal(alpha, toEye, r2Point(i, Vec2(0.5f)))));
    return sum / kPoints;
}

/// The same out of diffuse light.
inline float ggxMeanAlbedo(float alpha) {
    constexpr int kPoints = 32;
    float sum = 0;
    for (int i = 0; i < kPoints; ++i)
        sum += ggxAlbedo(alpha, std::sqrt((static_cast<float>(i) + 0.5f) / kPoints));
    return sum / kPoints;
}

}  // namespace vlf
