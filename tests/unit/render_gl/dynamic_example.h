#pragma once
// Objects in small rooms, and the truth that their pictures are held against.

#include "open_gl.h"
#include "small_rooms.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/scene/generate/primitives.h"

#include <memory>
#include <string>
#include <utility>

namespace vlf::test {

inline Material matte(const Vec3& diffuse) {
    Material m;
    m.diffuse = diffuse;
    return m;
}

inline DynamicObject objectOf(std::shared_ptr<const ObjectModel> model, const Vec3& at,
                              float scale) {
    DynamicObject object;
    object.name = "object";
    object.model = std::move(model);
    object.pose.translation = at;
    object.pose.scale = scale;
    object.settings.shading = Shading::flat;
    object.settings.shadow = ShadowKind::none;
    return object;
}

inline DynamicObject objectOf(const std::string& primitive, const Vec3& at, float scale,
                              const Material& material = matte({0.7f, 0.1f, 0.1f})) {
    return objectOf(std::make_shared<const ObjectModel>(makePrimitive(primitive, material)), at,
                    scale);
}

/// How different the pictures of the room by OpenGL and by the CPU are.
inline double flipAgainstCpu(const BakedExample& room, const DynamicRoom& objects,
                             StillParams params) {
    params.objects = &objects;
    return flipAgainstCpu(room, params);
}

/// Whether a ray meets an object first, after being reflected so often by mirrors of the room.
inline bool meetsObject(const DynamicRoom& room, const RayScene& rays, const Ray& ray,
                        int reflections) {
    const Hit hit = rays.closest(ray);
    const InstanceHit object = room.rays().closest(ray);
    if (object && !(hit && hit.t < object.hit.t)) return reflections == 0;
    if (!hit || reflections == 0 || !room.scene().material(hit.triangle).isMirror()) return false;
    const Vec3 normal = geometricNormal(room.scene(), hit.triangle);
    const Vec3 direction = glm::reflect(ray.direction, normal);
    const Vec3 origin = ray.origin + hit.t * ray.direction + rays.epsilon() * direction;
    return meetsObject(room, rays, {origin, direction}, reflections - 1);
}

inline Image drawn(Renderer& renderer, const StillParams& params) {
    Progress progress;
    return renderStill(renderer, params, progress);
}

}  // namespace vlf::test
