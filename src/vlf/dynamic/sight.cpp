#include "vlf/dynamic/sight.h"

#include <algorithm>

namespace vlf {

namespace {
constexpr float kMinThroughput = 1e-4f;
}

std::uint32_t RoomSights::texelAt(std::uint32_t chart, const Vec3& position) const {
    const Chart& c = room_.unwrap.charts[chart];
    const Vec2 t = c.texelCoordinates(position);
    const auto x = static_cast<std::uint32_t>(std::clamp(t.x, 0.0f, c.width - 1.0f));
    const auto y = static_cast<std::uint32_t>(std::clamp(t.y, 0.0f, c.height - 1.0f));
    return room_.source[(c.y + y) * room_.unwrap.atlasWidth + c.x + x];
}

Vec3 RoomSights::emissionAt(const Material& material, const Hit& hit, bool front) const {
    if (!material.isEmitter() || !(front || material.emitsBothSides)) return Vec3(0);
    return emittedRadiance(scene_, material, uvAt(scene_, hit.triangle, hit.barycentric));
}

void RoomSights::reflect(Scratch::Path path, const Ray& ray, const Hit& hit, std::uint32_t chart,
                         bool front, const Vec3& position, Scratch& scratch) const {
    path.throughput *= mirrorReflectance(scene_, scene_.material(hit.triangle),
                                         uvAt(scene_, hit.triangle, hit.barycentric));
    path.distance += hit.t;
    const Vec3 side = geometricNormal(scene_, hit.triangle) * (front ? 1.0f : -1.0f);
    const bool planar = room_.unwrap.charts[chart].planar;
    Vec3 normal = planar ? side : shadingNormalAt(scene_, hit.triangle, hit.barycentric);
    if (glm::dot(normal, side) < 0) normal = -normal;
    const Vec3 reflected = glm::reflect(ray.direction, normal);
    if (glm::dot(reflected, side) <= 0 || maxComponent(path.throughput) < kMinThroughput) return;
    scratch.nextRays.push_back({position + rays_.epsilon() * side, reflected});
    scratch.nextPaths.push_back(path);
}

}  // namespace vlf
