#include "vlf/dynamic/object_emitters.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/dynamic/texel_square.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr int kPoints = 128;  // of all emitting surfaces of an object
constexpr float kOff = 4;     // ray epsilons that a shadow ray ends before an emitter

}  // namespace

std::unique_ptr<const ObjectEmitters> makeEmitters(const DynamicObject& object,
                                                   const Unwrap& unwrap, std::uint32_t number) {
    Scene posed = posedScene(Scene{}, {&object, 1});
    for (Material& material : posed.materials) material.mirror = Vec3(0);  // they have no images
    auto emitters = std::make_unique<ObjectEmitters>();
    emitters->number = number;
    emitters->points = spreadPoints(posed, findLightSources(posed, unwrap), kPoints, 0);
    return emitters;
}

Vec3 EmittedLight::irradiance(const EmitterPoints& emitters, const Vec3& point, const Vec3& normal,
                              const Vec3& geometric) {
    rays_.clear(), light_.clear();
    solidAngles_.resize(emitters.points.size());
    const Vec3 origin = point + room_.epsilon() * geometric;
    for (const EmitterShare& share : emitters.shares) {
        solidAngles(emitters, share, point,
                    std::span(solidAngles_).subspan(share.first, share.count));
        for (std::uint32_t p = share.first; p < share.first + share.count; ++p) {
            const EmitterPoint& emitter = emitters.points[p];
            const Vec3 target = emitter.position + kOff * room_.epsilon() * emitter.normal;
            const Vec3 way = target - origin;
            const float cosine = glm::dot(normal, way) / glm::length(way);
            if (solidAngles_[p] <= 0 || cosine <= 0 || glm::dot(geometric, way) <= 0) continue;
            rays_.push_back({origin, way, 0, 1});
            light_.push_back(solidAngles_[p] * cosine * emitter.radiance);
        }
    }
    blocked_.resize(rays_.size()), blockedByObject_.resize(rays_.size());
    room_.occluded(rays_, blocked_);
    objects_.occluded(rays_, blockedByObject_);
    Vec3 sum(0);
    for (std::size_t i = 0; i < rays_.size(); ++i)
        if (!blocked_[i] && !blockedByObject_[i]) sum += light_[i];
    return sum;
}

void findEmittedLight(const ObjectEmitters& emitters, const Scene& scene, const RayScene& rays,
                      const RoomTexels& room, const Coverage& coverage, const RayInstances& objects,
                      std::vector<TexelChange>& light) {
    std::vector<std::vector<TexelChange>> parts(room.groups.size());
    parallelFor(room.groups.size(), 8, [&](std::size_t g) {
        EmittedLight emitted(rays, objects);
        const auto find = [&](std::uint32_t entry) {
            const auto points = coverage.points(room, entry);
            if (points.empty()) return Vec3(0);
            const SurfacePoint& p = points[points.size() / 2];
            const LightReceiver texel = texelReceiver(scene, room.unwrap, entry);
            const Vec3 geometric = texel.side * geometricNormal(scene, p.triangle);
            Vec3 normal = shadingNormalAt(scene, p.triangle, p.barycentric);
            if (glm::dot(normal, geometric) < 0) normal = -normal;
            const Vec3 point = positionAt(scene, p.triangle, p.barycentric);
            return emitted.irradiance(emitters.points, point, normal, geometric);
        };
        TexelSquare(room, room.groups[g])
            .light(0, find, [&](std::uint32_t texel, const Vec3& irradiance) {
                if (irradiance != Vec3(0)) parts[g].push_back({texel, irradiance});
            });
    });
    for (const std::vector<TexelChange>& part : parts)
        light.insert(light.end(), part.begin(), part.end());
}

}  // namespace vlf
