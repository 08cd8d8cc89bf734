#include "vlf/render/cpu/hard_shadows.h"

#include <algorithm>

namespace vlf {

namespace {
constexpr int kMaxLamps = 8;  // passed on the way to the light
}

std::vector<HardShadows::Caster> hardShadowCasters(const DynamicRoom& objects) {
    std::vector<HardShadows::Caster> casters;
    for (std::size_t i = 0; i < objects.litObjects().size(); ++i) {
        const ObjectSettings& settings = objects.object(objects.litNumbers()[i]).settings;
        if (settings.shadow == ShadowKind::hard && settings.hard.opacity > 0)
            casters.push_back({&objects.litObjects()[i], settings.hard.opacity});
    }
    return casters;
}

float HardShadows::remaining(const Surface& surface) const {
    if (casters_.empty() || !light_) return 1;
    const Vec3 origin = surface.position + rays_.epsilon() * surface.geometricNormal;
    const Vec3 toLight = light_->position - origin;
    if (glm::dot(toLight, surface.geometricNormal) <= 0) return 1;
    if (light_->factor(-glm::normalize(toLight)) <= 0) return 1;
    const Ray ray{origin, toLight, 0, 1};
    const float opacity = opacityTowardsLight(ray);
    return opacity > 0 && reachesLight(ray) ? 1 - opacity : 1;
}

/// The greatest of the objects in the way.
float HardShadows::opacityTowardsLight(const Ray& ray) const {
    float opacity = 0;
    for (const Caster& caster : casters_) {
        if (caster.opacity <= opacity) continue;
        const Pose& pose = caster.object->pose;
        const Ray own{pose.inversePoint(ray.origin),
                      pose.inverseDirection(ray.direction) / pose.scale, ray.tMin, ray.tMax};
        if (caster.object->mesh->rays.occluded(own)) opacity = caster.opacity;
    }
    return opacity;
}

bool HardShadows::reachesLight(Ray ray) const {
    const float length = glm::length(ray.direction);
    ray.tMax = 1 - rays_.epsilon() / length;
    for (int lamps = 0; lamps < kMaxLamps; ++lamps) {
        const Hit hit = rays_.closest(ray);
        if (!hit) return true;
        if (!scene_.material(hit.triangle).isEmitter()) return false;
        ray.tMin = hit.t + rays_.epsilon() / length;
    }
    return true;
}

}  // namespace vlf
