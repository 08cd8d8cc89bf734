#pragma once
// Smooth glass: what share of the light it reflects, and where the rest goes. Unpolarised light
// (Fresnel's equations; M. Born and E. Wolf, "Principles of Optics", 1.5).
//
// Light that passes into a medium n times as dense has n² times the radiance there, since its
// directions draw together; on the way out it loses that again.

#include "vlf/math/vector.h"

#include <algorithm>

namespace vlf {

/// The share that a surface reflects of a ray with this cosine of incidence, in [0, 1]. `eta`:
/// index of refraction beyond the surface by that before it. 1 where nothing passes.
inline float fresnelReflectance(float cosine, float eta) {
    const float c = std::clamp(cosine, 0.0f, 1.0f);
    const float beyond2 = 1 - (1 - c * c) / (eta * eta);
    if (beyond2 <= 0) return 1;
    const float beyond = std::sqrt(beyond2);
    const float parallel = (eta * c - beyond) / (eta * c + beyond);
    const float across = (c - eta * beyond) / (c + eta * beyond);
    return 0.5f * (parallel * parallel + across * across);
}

/// The same of a pane with two parallel faces, with all reflections between them: R + T² R + T² R³
/// + ... = 2 R / (1 + R), where T = 1 - R.
inline float paneReflectance(float cosine, float ior) {
    const float r = fresnelReflectance(cosine, ior);
    return 2 * r / (1 + r);
}

/// How glass divides the light that leaves it along a ray towards the eye.
struct GlassSplit {
    float reflectance = 1;  ///< share of the reflected ray
    Vec3 reflected{0};      ///< unit directions in which to look for the light
    Vec3 transmitted{0};
    float transmittance = 0;  ///< share of the transmitted ray: 1 - reflectance
    float radianceScale = 1;  ///< by which radiance beyond the surface is multiplied besides
};

struct GlassMedium {
    float ior = 1.5f;  ///< index of refraction
    bool thin = true;  ///< a pane, which rays pass straight
};

/// For a ray along unit `incoming` that meets a surface. `shading` and `geometric`: unit normals on
/// the side that is met; `outside`: whether that is the air's side (of a pane, either).
inline GlassSplit splitAtGlass(const GlassMedium& medium, const Vec3& incoming, const Vec3& shading,
                               const Vec3& geometric, bool outside) {
    constexpr float kGrazing = 1e-4f;
    GlassSplit split;
    Vec3 normal = glm::dot(shading, incoming) < -kGrazing ? shading : geometric;
    split.reflected = glm::reflect(incoming, normal);
    if (glm::dot(split.reflected, geometric) <= 0)
        split.reflected = glm::reflect(incoming, geometric);
    if (medium.thin) {
        split.reflectance = paneReflectance(-glm::dot(geometric, incoming), medium.ior);
        split.transmitted = incoming;
    } else {
        const float eta = outside ? medium.ior : 1 / medium.ior;
        split.transmitted = glm::refract(incoming, normal, 1 / eta);
        if (glm::dot(split.transmitted, geometric) >= 0) {
            normal = geometric;
            split.transmitted = glm::refract(incoming, normal, 1 / eta);
        }
        split.reflectance = fresnelReflectance(-glm::dot(normal, incoming), eta);
        split.radianceScale = 1 / (eta * eta);
        if (split.transmitted == Vec3(0)) split.reflectance = 1;
    }
    split.transmittance = 1 - split.reflectance;
    return split;
}

/// Where both rays are followed: of the weaker one if at least this share of the light at the eye
/// is left of it. What is less is lost.
inline constexpr float kLeastBranch = 0.02f;

/// Calls follow(direction, offset, weight) for the rays that are followed by this rule: the
/// stronger one and, if it is worth it, the other. `offset`: 1 or -1, the side of `geometric` on
/// which the ray starts. `tint`: of the glass; `throughput`: of the path so far.
template <class Follow>
void followGlass(const GlassSplit& split, const Vec3& tint, const Vec3& throughput, Follow follow) {
    const bool transmits = split.transmittance * maxComponent(tint) > split.reflectance;
    const auto isWorth = [&](float share) {
        return share > 0 && share * maxComponent(throughput) >= kLeastBranch;
    };
    if (!transmits || isWorth(split.reflectance))
        follow(split.reflected, 1.0f, Vec3(split.reflectance));
    if (transmits || isWorth(split.transmittance * maxComponent(tint)))
        follow(split.transmitted, -1.0f, split.transmittance * split.radianceScale * tint);
}

/// Mean of a reflectance over diffuse light, by quadrature.
template <class Reflectance>
float meanReflectance(Reflectance reflectance) {
    constexpr int kPoints = 64;
    float sum = 0;
    for (int i = 0; i < kPoints; ++i)
        sum += reflectance(std::sqrt((static_cast<float>(i) + 0.5f) / kPoints));
    return sum / kPoints;
}

}  // namespace vlf
