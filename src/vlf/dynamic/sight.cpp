#include "vlf/dynamic/sight.h"

#include "vlf/base/thread_memory.h"
#include "vlf/math/microfacet.h"
#include "vlf/propagate/ray_gather.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace vlf {

namespace {
constexpr float kMinThroughput = 1e-4f;

/// The same for the same ray, so that light does not flicker.
Vec2 drawFor(const Ray& ray) {
    const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
    RandomStream random(bits(ray.direction.x) << 32 | bits(ray.direction.y),
                        bits(ray.origin.x) << 32 | bits(ray.origin.z));
    return random.next2();
}
}  // namespace

void SightTracer::trace(std::span<const Ray> rays, Sights& sights) {
    const ThreadMemory<Memory> lent(memory_);
    sights_ = &sights;
    sights.others.clear();
    sights.texel.assign(rays.size(), kNoTexel);
    sights.distance.resize(rays.size());
    sights.within.assign(rays.size(), 0);
    memory_.nextQueue.clear(), memory_.nextPaths.clear();
    findHits(rays, true);
    for (std::uint32_t i = 0; i < rays.size(); ++i) meet({i, 0, true, 0, Vec3(1)}, rays[i], i);
    while (!memory_.nextQueue.empty()) {
        std::swap(memory_.queue, memory_.nextQueue), std::swap(memory_.paths, memory_.nextPaths);
        memory_.nextQueue.clear(), memory_.nextPaths.clear();
        findHits(memory_.queue, false);
        for (std::size_t i = 0; i < memory_.queue.size(); ++i)
            meet(memory_.paths[i], memory_.queue[i], i);
    }
}

void SightTracer::findHits(std::span<const Ray> rays, bool first) {
    memory_.hits.resize(rays.size());
    rays_.closest(rays, memory_.hits);
    const bool alone = objects_.lit.size() == 1 && objects_.own == 0;
    if (!objects_.rays || objects_.rays->empty() || (first && alone)) {
        memory_.objectHits.clear();
        return;
    }
    memory_.objectHits.resize(rays.size());
    if (first && objects_.own != kNoObject)
        objects_.rays->closestBut(objects_.own, rays, memory_.objectHits);
    else
        objects_.rays->closest(rays, memory_.objectHits);
}

void SightTracer::meet(const Path& path, const Ray& ray, std::size_t i) {
    if (!memory_.objectHits.empty() && memory_.objectHits[i] &&
        memory_.objectHits[i].hit.t < memory_.hits[i].t)
        meetObject(path, ray, memory_.objectHits[i]);
    else if (memory_.hits[i])
        meetRoom(path, ray, memory_.hits[i]);
    else if (room_.sources.sky && !std::isfinite(ray.tMax))
        leave(path, ray);
}

/// Only the bright part of the environment is sampled as direct light.
void SightTracer::leave(const Path& path, const Ray& ray) {
    const Sky& sky = room_.sources.sky->sky;
    const Vec3 direction = glm::normalize(ray.direction);
    Sight sight;
    sight.ray = path.ray;
    sight.inMirror = path.reflections > 0;
    sight.distance = std::numeric_limits<float>::infinity();
    sight.throughput = path.throughput;
    sight.emission = sky.smooth(direction);
    sight.emissionApart = false;
    if (sight.emission != Vec3(0)) sights_->others.push_back(sight);
    sight.emission = sky.bright(direction);
    sight.emissionApart = room_.sources.covers(path.reflections, path.planarOnly);
    if (sight.emission != Vec3(0)) sights_->others.push_back(sight);
}

void SightTracer::meetRoom(const Path& path, const Ray& ray, const Hit& hit) {
    const RoomTriangle& triangle = room_.triangles[hit.triangle];
    const bool front = glm::dot(triangle.areaVector, ray.direction) < 0;
    if (!triangle.plain && scene_.material(hit.triangle).isGlass())
        return passGlass(path, ray, hit, front);
    const std::uint32_t chart = front ? triangle.charts.front : triangle.charts.back;
    const Vec3 position = ray.origin + hit.t * ray.direction;
    const std::uint32_t texel = chart == kNoChart ? kNoTexel : atlasTexel(chart, position);
    if (texel == kNoTexel || room_.excluded[texel]) {
        if (path.reflections == 0 && path.glass == 0) sights_->within[path.ray] = 1;
        return;
    }
    if (triangle.plain && path.reflections == 0 && path.glass == 0 &&
        room_.source[texel] == texel) {
        sights_->texel[path.ray] = texel;
        sights_->distance[path.ray] = hit.t;
        return;
    }
    Sight sight;
    sight.ray = path.ray;
    sight.texel = room_.source[texel];
    sight.covered = sight.texel == texel;
    sight.triangle = hit.triangle;
    sight.barycentric = hit.barycentric;
    sight.front = front;
    sight.inMirror = path.reflections > 0;
    sight.distance = path.distance + hit.t;
    sight.throughput = path.throughput;
    if (triangle.plain) {
        sights_->others.push_back(sight);
        return;
    }
    const Material& material = scene_.material(hit.triangle);
    if (material.isEmitter() && (front || material.emitsBothSides)) {
        sight.emission =
            emittedRadiance(scene_, material, uvAt(scene_, hit.triangle, hit.barycentric));
        sight.emissionApart =
            room_.sources.covers(path.reflections, path.planarOnly, path.glass > 0);
    }
    if (!material.isPureMirror() || material.isEmitter()) sights_->others.push_back(sight);
    if (!material.isMirror()) return;
    const Vec3 side = geometricNormal(scene_, hit.triangle) * (front ? 1.0f : -1.0f);
    const bool planar = room_.unwrap.charts[chart].planar;
    const Vec3 normal = planar ? side : shadingNormalAt(scene_, hit.triangle, hit.barycentric);
    reflect(path, ray, hit.t,
            {position, normal, side,
             mirrorReflectance(scene_, material, uvAt(scene_, hit.triangle, hit.barycentric)),
             material.roughness, rays_.epsilon(), planar && !material.isGlossy()});
}

/// Straight on, through solids too.
void SightTracer::passGlass(Path path, const Ray& ray, const Hit& hit, bool front) {
    const Material& glass = scene_.material(hit.triangle);
    const Vec3 side = geometricNormal(scene_, hit.triangle) * (front ? 1.0f : -1.0f);
    const Vec3 direction = glm::normalize(ray.direction);
    const float share =
        1 - (glass.thin ? paneReflectance(-glm::dot(side, direction), glass.ior)
                        : fresnelReflectance(-glm::dot(side, direction), glass.ior));
    path.throughput *= share * glass.transmission;
    path.distance += hit.t;
    path.planarOnly = path.planarOnly && glass.thin;
    if (++path.glass > kMaxReflections || maxComponent(path.throughput) < kMinThroughput) return;
    const Vec3 position = ray.origin + hit.t * ray.direction;
    memory_.nextQueue.push_back({position - rays_.epsilon() * side, ray.direction});
    memory_.nextPaths.push_back(path);
}

void SightTracer::meetObject(const Path& path, const Ray& ray, const InstanceHit& found) {
    const LitObject& object = objects_.lit[found.instance];
    const Scene& scene = object.mesh->scene;
    const Hit& hit = found.hit;
    const Vec3 winding = object.pose.direction(geometricNormal(scene, hit.triangle));
    Sight sight;
    sight.ray = path.ray;
    sight.object = found.instance;
    sight.triangle = hit.triangle;
    sight.barycentric = hit.barycentric;
    sight.front = glm::dot(winding, ray.direction) < 0;
    sight.inMirror = path.reflections > 0;
    sight.distance = path.distance + hit.t;
    sight.throughput = path.throughput;
    if (!sight.front && object.mesh->closed) return;
    const Material& material = scene.material(hit.triangle);
    const Vec2 uv = uvAt(scene, hit.triangle, hit.barycentric);
    if (material.isEmitter() && (sight.front || material.emitsBothSides))
        sight.emission = emittedRadiance(scene, material, uv),
        sight.emissionApart = !sight.inMirror;
    if (!material.isPureMirror() || material.isEmitter()) sights_->others.push_back(sight);
    if (!material.isMirror()) return;
    const float scale = object.pose.scale;
    reflect(path, ray, hit.t,
            {ray.origin + hit.t * ray.direction,
             object.pose.direction(shadingNormalAt(scene, hit.triangle, hit.barycentric)),
             sight.front ? winding : -winding, mirrorReflectance(scene, material, uv),
             material.roughness, std::max(rays_.epsilon(), scale * object.mesh->rays.epsilon()),
             false});
}

void SightTracer::reflect(Path path, const Ray& ray, float t, const MirrorPoint& mirror) {
    path.throughput *= mirror.reflectance;
    path.distance += t;
    path.planarOnly = path.planarOnly && mirror.planar;
    if (++path.reflections > kMaxReflections || maxComponent(path.throughput) < kMinThroughput)
        return;
    const Vec3 normal = glm::dot(mirror.normal, mirror.side) < 0 ? -mirror.normal : mirror.normal;
    Vec3 reflected = glm::reflect(ray.direction, normal);
    if (mirror.roughness > 0) {
        const Vec3& facing = glm::dot(normal, ray.direction) < 0 ? normal : mirror.side;
        const GlossyReflection glossy =
            sampleGgxReflection(mirror.roughness, ray.direction, facing, drawFor(ray));
        path.throughput *= glossy.weight;
        reflected = glossy.direction;
    }
    if (glm::dot(reflected, mirror.side) <= 0) return;
    memory_.nextQueue.push_back({mirror.position + mirror.epsilon * mirror.side, reflected});
    memory_.nextPaths.push_back(path);
}

std::uint32_t SightTracer::atlasTexel(std::uint32_t chart, const Vec3& position) const {
    const Chart& c = room_.unwrap.charts[chart];
    const Vec2 t = c.texelCoordinates(position);
    const auto x = static_cast<std::uint32_t>(std::clamp(t.x, 0.0f, c.width - 1.0f));
    const auto y = static_cast<std::uint32_t>(std::clamp(t.y, 0.0f, c.height - 1.0f));
    return (c.y + y) * room_.unwrap.atlasWidth + c.x + x;
}

Vec3 diffuseRadiance(const Sight& sight, std::span<const Vec3> texelRadiance,
                     std::span<const LitObject> lit) {
    if (sight.texel != kNoTexel) return texelRadiance[sight.texel];
    if (sight.object == kNoObject) return Vec3(0);
    const LitObject& object = lit[sight.object];
    const Scene& scene = object.mesh->scene;
    const Vec3 reflectance = diffuseReflectance(scene, scene.material(sight.triangle),
                                                uvAt(scene, sight.triangle, sight.barycentric));
    return reflectance * object.irradiance(sight.triangle, sight.barycentric, sight.front) / kPi;
}

}  // namespace vlf
