#include "vlf/render/cpu/surface.h"

namespace vlf {

SidePoint pointFacing(const Scene& scene, const Hit& hit, const Vec3& direction) {
    const bool front = glm::dot(areaVector(scene, hit.triangle), direction) < 0;
    return {hit.triangle, hit.barycentric, front};
}

Surface surfaceAt(const Scene& scene, const SidePoint& point) {
    const Material& material = scene.material(point.triangle);
    const Vec2 uv = uvAt(scene, point.triangle, point.barycentric);
    Surface surface;
    surface.point = point;
    surface.position = positionAt(scene, point.triangle, point.barycentric);
    surface.geometricNormal = geometricNormal(scene, point.triangle) * (point.front ? 1.0f : -1.0f);
    surface.normal = shadingNormalAt(scene, point.triangle, point.barycentric);
    if (glm::dot(surface.normal, surface.geometricNormal) < 0) surface.normal = -surface.normal;
    surface.diffuse = diffuseReflectance(scene, material, uv);
    surface.mirror = mirrorReflectance(scene, material, uv);
    surface.roughness = material.roughness;
    return surface;
}

Vec3 emittedRadiance(const Scene& scene, const SidePoint& point) {
    const Material& material = scene.material(point.triangle);
    if (!material.isEmitter() || !(point.front || material.emitsBothSides)) return Vec3(0);
    return emittedRadiance(scene, material, uvAt(scene, point.triangle, point.barycentric));
}

float cosineLobe(const Surface& surface, const Vec3& direction) {
    const float cosine = glm::dot(surface.normal, direction);
    if (cosine <= 0 || glm::dot(surface.geometricNormal, direction) <= 0) return 0;
    const float tilt = glm::dot(surface.normal, surface.geometricNormal);
    return cosine / (kPi * 0.5f * (1 + tilt));
}

Vec3 mirrorDirection(const Surface& surface, const Vec3& incoming) {
    const Vec3 reflected = glm::reflect(incoming, surface.normal);
    return glm::dot(reflected, surface.geometricNormal) > 0
               ? reflected
               : glm::reflect(incoming, surface.geometricNormal);
}

}  // namespace vlf
