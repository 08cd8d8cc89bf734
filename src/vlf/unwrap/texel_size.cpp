#include "vlf/unwrap/texel_size.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr float kTurnPerTexel = 0.1f;  // radians

/// Mean square over directions of the shading normal's change per metre, m⁻²: 1 / r² on a sphere.
/// With the edges' Gram matrix G and that of the normals' changes along them H it is tr(G⁻¹ H) / 2.
float squaredCurvature(const Scene& scene, std::uint32_t t) {
    const Vec3 e = scene.position(t, 1) - scene.position(t, 0);
    const Vec3 f = scene.position(t, 2) - scene.position(t, 0);
    const Vec3 n = shadingNormalAt(scene, t, {0, 0});
    const Vec3 p = shadingNormalAt(scene, t, {1, 0}) - n;
    const Vec3 q = shadingNormalAt(scene, t, {0, 1}) - n;
    const float ee = glm::dot(e, e), ef = glm::dot(e, f), ff = glm::dot(f, f);
    const float determinant = ee * ff - ef * ef;
    if (!(determinant > 0)) return 0;
    const float trace = ff * glm::dot(p, p) - 2 * ef * glm::dot(p, q) + ee * glm::dot(q, q);
    return std::max(0.0f, 0.5f * trace / determinant);
}

bool isDiffuse(const Material& material) {
    return maxComponent(material.diffuse) > 0;
}

/// Texels per flat texel's area, at least 1.
float density(const Scene& scene, std::uint32_t t, float flatSize) {
    if (!isDiffuse(scene.material(t))) return 1;
    const float turn = flatSize / kTurnPerTexel;
    return std::clamp(squaredCurvature(scene, t) * turn * turn, 1.0f, kFinestBend * kFinestBend);
}

}  // namespace

float texelSizeOf(const Scene& scene, std::span<const std::uint32_t> triangles, float flatSize) {
    double texels = 0, all = 0;
    for (const std::uint32_t t : triangles) {
        const double a = area(scene, t);
        texels += a * density(scene, t, flatSize);
        all += a;
    }
    return all > 0 ? static_cast<float>(flatSize * std::sqrt(all / texels)) : flatSize;
}

double texelsNeeded(const Scene& scene, float flatSize) {
    double texels = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        texels += static_cast<double>(area(scene, t)) * density(scene, t, flatSize);
    return texels / (static_cast<double>(flatSize) * flatSize);
}

float texelSizeForBudget(const Scene& scene, double budget) {
    double all = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) all += area(scene, t);
    // The more texels bent surfaces take, the fewer are left for flat ones: between these two.
    double lower = std::sqrt(all / budget), upper = kFinestBend * lower;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (lower + upper);
        (texelsNeeded(scene, static_cast<float>(middle)) > budget ? lower : upper) = middle;
    }
    return static_cast<float>(upper);
}

}  // namespace vlf
