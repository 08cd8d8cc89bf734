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
                                                   const Unwrap& unwrap, const Scene& scene,
                                                   const RoomTexels& room, std::uint32_t number) {
    Scene posed = posedScene(Scene{}, {&object, 1});
    for (Material& material : posed.materials) material.mirror = Vec3(0);  // they have no images
    LightSources sources = findLightSources(posed, unwrap);
    const std::vector<LightImage> straight = sources.images;
    for (std::uint32_t c = 0; c < room.unwrap.charts.size(); ++c) {
        if (!room.sources.planarMirror[c]) continue;
        const Vec3 point = room.sources.mirrorOffset[c] * room.unwrap.charts[c].normal;
        for (const LightImage& inner : straight)
            if (const auto image =
                    imageInMirror(scene, room.unwrap, c, point, sources.lights[inner.light], inner))
                sources.images.push_back(*image);
    }
    auto emitters = std::make_unique<ObjectEmitters>();
    emitters->number = number;
    emitters->points = spreadPoints(posed, sources, kPoints, 0);
    emitters->images = std::move(sources.images);
    return emitters;
}

Vec3 EmittedLight::irradiance(const ObjectEmitters& emitters, const Vec3& point, const Vec3& normal,
                              const Vec3& geometric) {
    ways_.clear(), queue_.clear();
    solidAngles_.resize(emitters.points.points.size());
    for (const EmitterShare& share : emitters.points.shares) {
        solidAngles(emitters.points, share, point,
                    std::span(solidAngles_).subspan(share.first, share.count));
        find(emitters, share, point + rays_.epsilon() * geometric, normal, geometric);
    }
    keepThoseByMirrors();
    blockRays();
    Vec3 sum(0);
    for (std::size_t i = 0; i < ways_.size(); ++i)
        if (!blocked_[i] && !blockedByObject_[i]) sum += ways_[i].light;
    return sum;
}

/// The ways from the points of one emitter or image.
void EmittedLight::find(const ObjectEmitters& emitters, const EmitterShare& share,
                        const Vec3& origin, const Vec3& normal, const Vec3& geometric) {
    const LightImage& image = emitters.images[share.image];
    const std::uint32_t mirror = image.depth > 0 ? image.mirror[0] : kNoChart;
    for (std::uint32_t p = share.first; p < share.first + share.count; ++p) {
        const EmitterPoint& emitter = emitters.points.points[p];
        const Vec3 target = emitter.position + kOff * rays_.epsilon() * emitter.normal;
        const Vec3 way = target - origin;
        const float cosine = glm::dot(normal, way) / glm::length(way);
        if (solidAngles_[p] <= 0 || cosine <= 0 || glm::dot(geometric, way) <= 0) continue;
        Way found{solidAngles_[p] * cosine * image.throughput * emitter.radiance, {}, mirror};
        Ray leg{origin, way, 0, 1};
        if (mirror != kNoChart) {
            const Vec3& n = room_.unwrap.charts[mirror].normal;
            const float plane = room_.sources.mirrorOffset[mirror];
            const float before = glm::dot(n, origin) - plane, behind = plane - glm::dot(n, target);
            if (before <= 0 || behind <= 0) continue;
            const float part = before / (before + behind);
            const Vec3 start = origin + part * way + rays_.epsilon() * n;
            found.fromMirror = {start, target + 2 * behind * n - start, 0, 1};
            leg.tMax = part;
        }
        ways_.push_back(found);
        queue_.push_back(leg);
    }
}

/// Of the ways that cross the plane of a mirror, those that meet it.
void EmittedLight::keepThoseByMirrors() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
        if (const std::uint32_t mirror = ways_[i].mirror; mirror != kNoChart) {
            Ray& leg = queue_[i];
            const float slack = kOff * rays_.epsilon() / glm::length(leg.direction);
            const Hit hit = rays_.closest({leg.origin, leg.direction, 0, leg.tMax + slack});
            if (!hit || hit.t < leg.tMax - slack) continue;
            const TriangleCharts& charts = room_.unwrap.triangleCharts[hit.triangle];
            if (charts.front != mirror && charts.back != mirror) continue;
            leg.tMax -= slack;
        }
        ways_[kept] = ways_[i];
        queue_[kept++] = queue_[i];
    }
    ways_.resize(kept), queue_.resize(kept);
}

/// By the room or objects, on either leg.
void EmittedLight::blockRays() {
    const std::size_t count = ways_.size();
    for (std::size_t i = 0; i < count; ++i)
        if (ways_[i].mirror != kNoChart) queue_.push_back(ways_[i].fromMirror);
    blocked_.resize(queue_.size()), blockedByObject_.resize(queue_.size());
    rays_.occluded(queue_, blocked_);
    objects_.occluded(queue_, blockedByObject_);
    for (std::size_t i = 0, leg = count; i < count; ++i)
        if (ways_[i].mirror != kNoChart) {
            blocked_[i] |= blocked_[leg] | blockedByObject_[leg];
            ++leg;
        }
}

void findEmittedLight(const ObjectEmitters& emitters, const Scene& scene, const RayScene& rays,
                      const RoomTexels& room, const Coverage& coverage, const RayInstances& objects,
                      std::vector<TexelChange>& light) {
    std::vector<std::vector<TexelChange>> parts(room.groups.size());
    parallelFor(room.groups.size(), 8, [&](std::size_t g) {
        EmittedLight emitted(rays, room, objects);
        const auto find = [&](std::uint32_t entry) {
            const auto points = coverage.points(room, entry);
            if (points.empty()) return Vec3(0);
            const SurfacePoint& p = points[points.size() / 2];
            const LightReceiver texel = texelReceiver(scene, room.unwrap, entry);
            const Vec3 geometric = texel.side * geometricNormal(scene, p.triangle);
            Vec3 normal = shadingNormalAt(scene, p.triangle, p.barycentric);
            if (glm::dot(normal, geometric) < 0) normal = -normal;
            const Vec3 point = positionAt(scene, p.triangle, p.barycentric);
            return emitted.irradiance(emitters, point, normal, geometric);
        };
        TexelSquare(room, room.groups[g])
            .light(
                0, [](const Sphere&) { return LightThere::even; }, find,
                [&](std::uint32_t texel, const Vec3& irradiance) {
                    if (irradiance != Vec3(0)) parts[g].push_back({texel, irradiance});
                });
    });
    for (const std::vector<TexelChange>& part : parts)
        light.insert(light.end(), part.begin(), part.end());
}

}  // namespace vlf
