#include "vlf/render/cpu/object_surface.h"

namespace vlf {

std::optional<Surface> surfaceOf(const LitObject& object, const Hit& hit, const Vec3& direction) {
    const Pose& pose = object.pose;
    const Scene& scene = object.mesh->scene;
    const SidePoint point = pointFacing(scene, hit, pose.inverseDirection(direction));
    if (!point.front && object.mesh->closed) return std::nullopt;
    Surface surface = surfaceAt(scene, point);
    surface.position = pose.point(surface.position);
    surface.normal = pose.direction(surface.normal);
    surface.geometricNormal = pose.direction(surface.geometricNormal);
    return surface;
}

Vec3 ownRadiance(const LitObject& object, const Surface& surface) {
    const SidePoint& point = surface.point;
    const Vec3 irradiance = object.irradiance(point.triangle, point.barycentric, point.front);
    return emittedRadiance(object.mesh->scene, point) + surface.diffuse * irradiance / kPi;
}

}  // namespace vlf
