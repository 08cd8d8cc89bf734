#include "vlf/render/cpu/field_shader.h"

#include "vlf/base/error.h"
#include "vlf/math/random.h"
#include "vlf/render/cpu/object_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace vlf {

namespace {

/// Longest chain of mirrors followed, as in the bake.
constexpr int kMaxReflections = 16;
constexpr float kMinThroughput = 1e-4f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Of the lobe of a rough mirror, and towards lamps, for each ray of the camera that meets it.
constexpr int kLobeRays = 8, kLampRays = 8;

/// Of unit or other `direction`.
GlassSplit splitAt(const Surface& surface, const Material& glass, const Vec3& direction) {
    return splitAtGlass(glass.medium(), glm::normalize(direction), surface.normal,
                        surface.geometricNormal, surface.point.front);
}

}  // namespace

/// A chain of reflections and transmissions from the eye.
struct FieldShader::Path {
    std::size_t ray;  ///< of the camera
    Vec3 throughput;
    float density = kCertain;  ///< with which a lobe drew the ray
    float straight = 0;        ///< metres before the ray, through panes
    bool spread = false;       ///< by a rough mirror: others are looked up
};

/// The rays of the camera and what they see.
struct FieldShader::Picture {
    std::span<const Ray> rays;
    int perPixel;
    std::span<Vec3> radiance;

    /// Of its pixel.
    std::size_t sampleOf(std::size_t ray) const { return ray % static_cast<std::size_t>(perPixel); }

    RandomStream randomOf(std::size_t ray) const { return {sampleOf(ray), pixelKey(ray)}; }

    /// Point i of n that cover the unit square evenly, also with those of the pixel's other rays.
    Vec2 point(std::size_t ray, int i, int n) const {
        return r2Point(static_cast<std::uint32_t>(sampleOf(ray) * n + i),
                       RandomStream(perPixel, pixelKey(ray)).next2());
    }

  private:
    std::uint64_t pixelKey(std::size_t ray) const {
        const Vec3& direction = rays[ray - sampleOf(ray)].direction;
        std::uint64_t key = 0;
        for (const std::uint32_t bits : std::bit_cast<std::array<std::uint32_t, 3>>(direction))
            key = mixBits(key + bits);
        return key;
    }
};

struct FieldShader::Queue {
    std::vector<Path> paths;
    std::vector<Ray> rays;

    void add(const Path& path, const Ray& ray) {
        paths.push_back(path);
        rays.push_back(ray);
    }
    void clear() {
        paths.clear();
        rays.clear();
    }
};

/// A point of the room that is seen.
struct FieldShader::RoomPoint {
    Surface surface;
    std::uint32_t chart;
    Vec3 own{0};          ///< radiance by emission and diffuse reflection
    float remaining = 1;  ///< of all radiance, in hard shadows; of `own` already

    Ray reflect(const Vec3& direction, float epsilon) const {
        return {surface.position + epsilon * surface.geometricNormal,
                mirrorDirection(surface, direction)};
    }
};

std::uint32_t chartAt(const LightField& field, const SidePoint& point) {
    const TriangleCharts& charts = field.triangleCharts[point.triangle];
    return point.front ? charts.front : charts.back;
}

FieldShader::FieldShader(const Scene& scene, const RayScene& rays, const LightField& field,
                         MirrorMethod mirrors, LookupKind lookup, const DynamicRoom* objects)
    : scene_(scene),
      rays_(rays),
      field_(field),
      mirrors_(mirrors),
      lookup_(lookup),
      objects_(objects && !objects->litObjects().empty() ? objects : nullptr),
      shadows_(scene, rays, objects_ ? objects_->hardShadowLight() : nullptr,
               objects_ ? hardShadowCasters(*objects_) : std::vector<HardShadows::Caster>{}) {
    if (field.triangleCharts.size() != scene.triangles.size())
        throw InputError("the light field belongs to another scene: bake this one");
    if (hasMirror(scene, MirrorKind::rough)) {
        if (field.gloss.empty())
            throw InputError(
                "the light field holds no radiance of rough mirrors: bake with gloss directions");
        gloss_.emplace(field.frame, field.gloss, MirrorKind::rough);
        if (!looksUp()) lamps_.emplace(scene, rays, objects_ ? &objects_->rays() : nullptr);
    }
    if (objects_ && (gloss_ || looksUp())) {
        changed_.emplace(scene, field);
        changed_->update(objects_->irradiance(), objects_->roomIrradiance());
    }
    if (!looksUp()) return;
    if (hasSpecular(scene, MirrorKind::perfect)) {
        if (field.radiance.empty())
            throw InputError(
                "the light field holds no radiance of mirrors or glass to look up: bake with "
                "radiance directions, or trace reflections (mode raytraced)");
        lookedUp_.emplace(field.frame, field.radiance);
    }
    if (objects_) fillProbes();
}

void FieldShader::fillProbes() {
    std::vector<ReflectionProbe> probes;
    for (const LitObject& object : objects_->litObjects()) {
        ReflectionProbe& probe = probes.emplace_back();
        if (!hasMirror(object.mesh->scene)) continue;
        const Vec3 centre = object.pose.point(boundingSphere(object.mesh->scene).centre);
        fillProbe(probe, centre, kProbeSize,
                  [&](std::span<const Ray> rays, std::span<Vec3> radiance, std::span<float> from) {
                      std::vector<Hit> hits(rays.size());
                      rays_.closest(rays, hits);
                      for (std::size_t i = 0; i < rays.size(); ++i) {
                          radiance[i] = hits[i]
                                            ? lookUpRoom(rays[i], hits[i])
                                            : skyRadiance(scene_.environment, rays[i].direction);
                          from[i] = hits[i].t;
                      }
                  });
    }
    probes_ = std::move(probes);
}

/// The room's, with what the objects change.
const IrradianceAtlas& FieldShader::atlas() const {
    return objects_ ? objects_->irradiance() : field_.atlas;
}

std::uint64_t FieldShader::radiance(std::span<const Ray> rays, std::span<Vec3> radiance,
                                    int perPixel) const {
    const Picture picture{rays, perPixel, radiance};
    std::fill(radiance.begin(), radiance.end(), Vec3(0));
    Queue queue, next;
    for (std::size_t i = 0; i < rays.size(); ++i) queue.add({i, Vec3(1)}, rays[i]);
    std::vector<Hit> hits;
    std::vector<InstanceHit> objectHits;
    std::uint64_t traced = 0;
    for (int reflections = 0; reflections <= kMaxReflections && !queue.rays.empty();
         ++reflections) {
        hits.resize(queue.rays.size());
        rays_.closest(queue.rays, hits);
        closestObjects(queue.rays, objectHits);
        traced += hits.size();
        for (std::size_t i = 0; i < hits.size(); ++i)
            if (objects_ && objectHits[i] && objectHits[i].hit.t < hits[i].t)
                followObject(queue.paths[i], queue.rays[i], objectHits[i], picture, next);
            else if (hits[i])
                followRoom(queue.paths[i], queue.rays[i], hits[i], picture, next);
            else
                picture.radiance[queue.paths[i].ray] +=
                    queue.paths[i].throughput * skySeen(queue.paths[i], queue.rays[i].direction);
        std::swap(queue, next);
        next.clear();
    }
    return traced;
}

void FieldShader::closestObjects(std::span<const Ray> rays, std::vector<InstanceHit>& hits) const {
    if (!objects_) return;
    hits.resize(rays.size());
    objects_->rays().closest(rays, hits);
}

std::optional<FieldShader::RoomPoint> FieldShader::roomPoint(const Path& path, const Ray& ray,
                                                             const Hit& hit) const {
    const SidePoint point = pointFacing(scene_, hit, ray.direction);
    const std::uint32_t chartIndex = chartAt(field_, point);
    if (chartIndex == kNoChart) return std::nullopt;
    const Chart& chart = field_.charts[chartIndex];
    RoomPoint seen{surfaceAt(scene_, point), chartIndex};
    Surface& surface = seen.surface;
    const Vec3 irradiance = atlas().sample(chart, chart.texelCoordinates(surface.position));
    seen.own = emitterSeen(path, point, ray, hit) + surface.diffuse * irradiance / kPi;
    seen.remaining = shadows_.remaining(surface);
    seen.own *= seen.remaining;
    if (chart.planar) surface.normal = surface.geometricNormal;
    if (const Material& m = scene_.material(hit.triangle); m.isGlass())
        surface.mirror = Vec3(splitAt(surface, m, ray.direction).reflectance);
    if (gloss_ && !surface.isPerfectMirror() && (path.spread || !tracesLobe(surface, ray))) {
        seen.own += seen.remaining * lookUpGloss(seen, ray);
        surface.mirror = Vec3(0);
    }
    return seen;
}

/// Whether the lobe of a rough mirror, seen along the ray, is narrower than the angle between the
/// field's directions: towards grazing angles it narrows sideways with the cosine.
bool FieldShader::tracesLobe(const Surface& surface, const Ray& ray) const {
    if (looksUp()) return false;
    const float cosine = -glm::dot(surface.normal, glm::normalize(ray.direction));
    return surface.roughness * cosine < std::sqrt(2 * kPi / static_cast<float>(field_.gloss.lines));
}

Vec3 FieldShader::skySeen(const Path& path, const Vec3& direction) const {
    const Vec3 radiance = skyRadiance(scene_.environment, direction);
    return path.density == kCertain ? radiance
                                    : radiance * lamps_->weightOfSky(direction, path.density);
}

Vec3 FieldShader::emitterSeen(const Path& path, const SidePoint& point, const Ray& ray,
                              const Hit& hit) const {
    const Vec3 emission = emittedRadiance(scene_, point);
    if (path.density == kCertain || emission == Vec3(0)) return emission;
    return emission *
           lamps_->weightOfEmitter(point, ray.direction, path.straight + hit.t, path.density);
}

/// Goes on behind glass, and with what it reflects as far as that is traced. False if that is
/// looked up, in solid glass with all that is seen in it.
bool FieldShader::followGlass(const Path& path, const Ray& ray, const Hit& hit,
                              const Picture& picture, Queue& next) const {
    const Material& glass = scene_.material(hit.triangle);
    if (!glass.isGlass() || (looksUp() && !glass.thin)) return false;
    const Surface surface = surfaceAt(scene_, pointFacing(scene_, hit, ray.direction));
    const GlassSplit split = splitAt(surface, glass, ray.direction);
    if (looksUp()) picture.radiance[path.ray] += path.throughput * lookUpSurface(ray, hit);
    vlf::followGlass(split, glass.transmission, path.throughput,
                     [&](const Vec3& direction, float side, const Vec3& weight) {
                         const Vec3 throughput = path.throughput * weight;
                         if (maxComponent(throughput) < kMinThroughput) return;
                         if (looksUp() && side > 0) return;
                         const Vec3 offset = side * rays_.epsilon() * surface.geometricNormal;
                         Path on{path.ray, throughput, kCertain, 0, path.spread};
                         if (glass.thin && side < 0)
                             on.density = path.density, on.straight = path.straight + hit.t;
                         next.add(on, {surface.position + offset, direction});
                     });
    return true;
}

void FieldShader::followRoom(const Path& path, const Ray& ray, const Hit& hit,
                             const Picture& picture, Queue& next) const {
    if (followGlass(path, ray, hit, picture, next)) return;
    if (looksUp()) {
        picture.radiance[path.ray] += path.throughput * lookUpSurface(ray, hit);
        return;
    }
    const std::optional<RoomPoint> point = roomPoint(path, ray, hit);
    if (!point) return;
    picture.radiance[path.ray] += path.throughput * point->own;
    const Vec3 throughput = point->remaining * path.throughput * point->surface.mirror;
    if (maxComponent(throughput) < kMinThroughput) return;
    if (point->surface.isPerfectMirror())
        next.add({path.ray, throughput, kCertain, 0, path.spread},
                 point->reflect(ray.direction, rays_.epsilon()));
    else
        followLobe({path.ray, point->remaining * path.throughput}, ray, point->surface, picture,
                   next);
}

/// What a rough mirror reflects: of lamps some samples, of them and all else some rays of its lobe.
void FieldShader::followLobe(const Path& path, const Ray& ray, const Surface& surface,
                             const Picture& picture, Queue& next) const {
    Surface mirror = surface;
    mirror.diffuse = Vec3(0);
    const Scattering lobe(mirror, -glm::normalize(ray.direction));
    RandomStream random = picture.randomOf(path.ray);
    Vec3 light = lamps_->punctual(mirror, lobe, random);
    for (int i = 0; i < kLampRays; ++i)
        light += (lamps_->emitters(mirror, lobe, random) + lamps_->sky(mirror, lobe, random)) /
                 static_cast<float>(kLampRays);
    picture.radiance[path.ray] += path.throughput * light;

    const Vec3 origin = surface.position + rays_.epsilon() * surface.geometricNormal;
    for (int i = 0; i < kLobeRays; ++i) {
        const Vec3 direction = lobe.drawGloss(picture.point(path.ray, i, kLobeRays));
        const float density = lobe.density(direction);
        if (!(density > 0)) continue;
        const Vec3 throughput =
            path.throughput * lobe.lobes(direction) / (density * static_cast<float>(kLobeRays));
        if (maxComponent(throughput) > 0)
            next.add({path.ray, throughput, density, 0, true}, {origin, direction});
    }
}

void FieldShader::followObject(const Path& path, const Ray& ray, const InstanceHit& hit,
                               const Picture& picture, Queue& next) const {
    if (looksUp()) {
        picture.radiance[path.ray] += path.throughput * lookUpObject(ray, hit, 0);
        return;
    }
    const LitObject& object = objects_->litObjects()[hit.instance];
    const std::optional<Surface> surface = surfaceOf(object, hit.hit, ray.direction);
    if (!surface) return;
    picture.radiance[path.ray] += path.throughput * ownRadiance(object, *surface);
    const Vec3 throughput = path.throughput * surface->mirror;
    if (maxComponent(throughput) < kMinThroughput) return;
    next.add({path.ray, throughput, kCertain, 0, path.spread},
             {surface->position + rays_.epsilon() * surface->geometricNormal,
              mirrorDirection(*surface, ray.direction)});
}

/// What a ray of a reflection probe sees, by way of panes.
Vec3 FieldShader::lookUpRoom(const Ray& ray, const Hit& hit) const {
    Vec3 seen(0), throughput(1);
    Ray rest = ray;
    Hit next = hit;
    for (int panes = 0; next && panes <= kMaxReflections; ++panes) {
        seen += throughput * lookUpSurface(rest, next);
        const Material& glass = scene_.material(next.triangle);
        if (!glass.isPane()) break;
        const Surface surface = surfaceAt(scene_, pointFacing(scene_, next, rest.direction));
        throughput *= splitAt(surface, glass, rest.direction).transmittance * glass.transmission;
        rest.origin = surface.position - rays_.epsilon() * surface.geometricNormal;
        next = rays_.closest(rest);
    }
    return seen;
}

/// What leaves the room's surface itself, of a pane without what is behind it.
Vec3 FieldShader::lookUpSurface(const Ray& ray, const Hit& hit) const {
    const std::optional<RoomPoint> point = roomPoint({0, Vec3(1), kCertain, 0, true}, ray, hit);
    if (!point) return Vec3(0);
    if (!lookedUp_ || maxComponent(point->surface.mirror) < kMinThroughput) return point->own;
    return point->own + point->remaining * lookUpMirror(*point, ray);
}

/// What a mirror of the room shows.
Vec3 FieldShader::lookUpMirror(const RoomPoint& point, const Ray& ray) const {
    const Surface& surface = point.surface;
    const SeenInMirror sight = lookedUp_->see(
        {point.chart, surface.position, surface.geometricNormal}, -ray.direction, lookup_);
    if (!objects_ || scene_.material(surface.point.triangle).isSolidGlass()) return sight.radiance;
    const Ray reflected = point.reflect(ray.direction, rays_.epsilon());
    // What stands on a surface is nearer than it by less than the lookup's distances are exact.
    const float behind = sight.distance > 0 ? sight.distance + changed_->tolerance() : kInfinity;
    if (const InstanceHit hit = closestObject(reflected, behind))
        return surface.mirror * lookUpObject(reflected, hit, 1);
    return inChangedLight(sight, reflected);
}

/// What a rough mirror of the room shows; objects but for the light that they take are not in it.
Vec3 FieldShader::lookUpGloss(const RoomPoint& point, const Ray& ray) const {
    const Surface& surface = point.surface;
    const SeenInMirror sight = gloss_->see({point.chart, surface.position, surface.geometricNormal},
                                           -ray.direction, lookup_);
    return objects_ ? inChangedLight(sight, point.reflect(ray.direction, rays_.epsilon()))
                    : sight.radiance;
}

Vec3 FieldShader::inChangedLight(const SeenInMirror& sight, const Ray& reflected) const {
    if (sight.distance <= 0) return sight.radiance;
    return sight.radiance * changed_->factor(reflected.origin, reflected.direction, sight.distance,
                                             objects_->irradiance(), objects_->roomIrradiance());
}

/// An object after a number of reflections.
Vec3 FieldShader::lookUpObject(const Ray& ray, const InstanceHit& hit, int reflections) const {
    const LitObject& object = objects_->litObjects()[hit.instance];
    const std::optional<Surface> surface = surfaceOf(object, hit.hit, ray.direction);
    if (!surface) return Vec3(0);
    const Vec3 own = ownRadiance(object, *surface);
    if (probes_.empty() || reflections == kMaxReflections ||
        maxComponent(surface->mirror) < kMinThroughput)
        return own;
    const Ray reflected{surface->position + rays_.epsilon() * surface->geometricNormal,
                        mirrorDirection(*surface, ray.direction)};
    const ProbeView room = lookUp(probes_[hit.instance], reflected.origin, reflected.direction);
    const InstanceHit next = closestObject(reflected, room.distance + changed_->tolerance());
    return own + surface->mirror *
                     (next ? lookUpObject(reflected, next, reflections + 1) : room.radiance);
}

InstanceHit FieldShader::closestObject(const Ray& ray, float before) const {
    return objects_->rays().closest({ray.origin, ray.direction, ray.tMin, before});
}

}  // namespace vlf
