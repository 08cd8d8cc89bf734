#include "vlf/dynamic/shadowed_texel.h"

#include "vlf/base/thread_memory.h"
#include "vlf/dynamic/soft_shadow.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr float kLarger = 2;
constexpr float kWorthAPatch = 0.5f;  // slight errors
constexpr float kNothing = 0.5f;      // likewise: not worth to be known
constexpr float kSameDistance = 1e-3f;

/// Of a sphere; of one around the point, all there is.
float solidAngleOf(const Vec3& point, const Sphere& sphere) {
    const Vec3 way = sphere.centre - point;
    const float sine2 = sphere.radius * sphere.radius / std::max(glm::dot(way, way), 1e-20f);
    return sine2 >= 1 ? 4 * kPi : 2 * kPi * (1 - std::sqrt(1 - sine2));
}

}  // namespace

ShadowedTexel::ShadowedTexel(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                             const RayInstances& casters, const Obstructions& obstructions,
                             const ShadowSampling& sampling)
    : scene_(scene),
      rays_(rays),
      room_(room),
      casters_(casters),
      obstructions_(obstructions),
      sampling_(sampling),
      gatherer_(scene, rays, room.unwrap, room.sources, 0) {
    gatherer_.setExtraOccluder(occluderOf(casters));
}

/// The more patches the more light an object may take.
int ShadowedTexel::stepFor(float taken) const {
    const float worth = std::min(taken / std::max(kWorthAPatch * sampling_.slight, 1e-20f),
                                 1.5f * static_cast<float>(sampling_.samples));
    return worth > 48 ? 1 : worth > 24 ? 2 : 4;
}

Vec3 ShadowedTexel::loss(const LightReceiver& receiver) {
    const ThreadMemory<Memory> lent(memory_);
    sort(receiver);
    Vec3 sum(0);
    if (anySampled_) {
        gatherer_.setImages(memory_.sampled);
        sum += gatherer_.irradianceBlocked(receiver, sampling_.samples);
    }
    if (!memory_.spots.empty()) findPoints(receiver);
    for (const Spot& spot : memory_.spots) sum += behind(spot);
    return sum;
}

/// Which images are to be sampled by their points, and which look larger than an object.
void ShadowedTexel::sort(const LightReceiver& receiver) {
    memory_.sampled.assign(obstructions_.size(), 0);
    memory_.spots.clear();
    anySampled_ = false;
    for (std::uint32_t i = 0; i < obstructions_.size(); ++i) {
        const LightImage& image = room_.sources.images[i];
        const Light& light = room_.sources.lights[image.light];
        float effect = -1;  // not known yet
        const Vec3 way = obstructions_.of(i).light.centre - receiver.centre;
        const float seen = light.area / std::max(glm::dot(way, way), 1e-20f);
        const float radiance = luminance(light.radiance * image.throughput);
        const std::size_t before = memory_.spots.size();
        for (const Obstruction::Object& object : obstructions_.of(i).objects) {
            if (!obstructions_.mayHide(receiver, i, object)) continue;
            if (effect < 0) effect = gatherer_.likelyEffect(receiver, image);
            if (effect <= kNothing * sampling_.slight) break;
            const float angle = solidAngleOf(receiver.centre, object.sphere);
            const bool larger = light.kind == LightKind::surface && seen > kLarger * angle;
            const float taken = larger ? std::min(effect, radiance * angle) : effect;
            if (taken <= kNothing * sampling_.slight) continue;
            if (!larger) {
                memory_.sampled[i] = anySampled_ = true;
                break;
            }
            memory_.spots.push_back({i, &object, stepFor(taken)});
        }
        if (memory_.sampled[i]) memory_.spots.resize(before);
    }
}

void ShadowedTexel::findPoints(const LightReceiver& r) {
    memory_.points.clear();
    for (const SurfacePoint& p : r.points) {
        const Vec3 geometric = r.side * geometricNormal(*r.scene, p.triangle);
        const Vec3 shading = shadingNormalAt(*r.scene, p.triangle, p.barycentric);
        memory_.points.push_back({positionAt(*r.scene, p.triangle, p.barycentric),
                                  glm::dot(shading, geometric) < 0 ? -shading : shading,
                                  geometric});
    }
}

/// Irradiance from an image that an object hides.
Vec3 ShadowedTexel::behind(const Spot& spot) {
    aim(spot);
    keepThoseThatMeet(spot);
    if (room_.sources.images[spot.image].depth == 0 && !rays_.hasPanes())
        return emissionStraight(spot);
    Vec3 sum(0);
    for (const Look& look : memory_.looks) sum += look.weight * emissionAlong(look, spot);
    return sum;
}

/// At the object's patches, of which those that face the texel are as large as its silhouette.
void ShadowedTexel::aim(const Spot& spot) {
    const ShadowCaster& caster = obstructions_.caster(spot.object->number);
    const auto patches = obstructions_.patches(spot.object->number);
    const LightPlane& plane = obstructions_.of(spot.image).plane;
    const int segment = spot.object->segment;
    const auto step = static_cast<std::size_t>(spot.step);
    const float area = caster.model->patchArea() * caster.pose.scale * caster.pose.scale *
                       static_cast<float>(spot.step);
    const bool closed = caster.model->mesh().closed;
    memory_.looks.clear();
    for (std::size_t k = step / 2; k < patches.size(); k += step) {
        const Point& p = memory_.points[k % memory_.points.size()];
        const Vec3 way =
            obstructions_.unfold(patches[k].position, spot.image, segment) - p.position;
        const float distance = glm::length(way);
        const Vec3 direction = way / distance;
        const float cosine = glm::dot(p.shading, direction);
        if (!(cosine > 0) || glm::dot(p.geometric, direction) <= 0) continue;
        float facing = -glm::dot(
            direction, obstructions_.unfoldDirection(patches[k].normal, spot.image, segment));
        if (!closed) facing = std::abs(facing);
        if (!(facing > 0)) continue;
        const Ray ray{p.position + rays_.epsilon() * p.geometric, direction};
        if (!plane.mayBeMet(ray, distance)) continue;
        memory_.looks.push_back(
            {ray,
             cosine / receiverLobe(p.shading, p.geometric) * facing * area / (distance * distance),
             distance});
    }
}

/// Their patch, and nothing else of the objects before it; from where it is seen behind mirrors.
void ShadowedTexel::keepThoseThatMeet(const Spot& spot) {
    const LightImage& image = room_.sources.images[spot.image];
    memory_.queue.clear();
    for (const Look& look : memory_.looks) {
        memory_.queue.push_back(look.ray);
        Ray& ray = memory_.queue.back();
        for (int k = 0; k < spot.object->segment; ++k) {
            const Vec3& n = room_.unwrap.charts[image.mirror[k]].normal;
            const float offset = room_.sources.mirrorOffset[image.mirror[k]];
            ray.origin -= 2 * (glm::dot(n, ray.origin) - offset) * n;
            ray.direction = glm::reflect(ray.direction, n);
        }
    }
    memory_.hits.resize(memory_.queue.size());
    casters_.closest(memory_.queue, memory_.hits);
    const float reach = spot.object->sphere.radius;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < memory_.looks.size(); ++k) {
        const InstanceHit& found = memory_.hits[k];
        const Look& look = memory_.looks[k];
        if (found && found.instance == spot.object->number &&
            std::abs(found.hit.t - look.met) < kSameDistance * reach + 4 * rays_.epsilon())
            memory_.looks[kept++] = look;
    }
    memory_.looks.resize(kept);
}

/// What an emitter would send along all looks without the object.
Vec3 ShadowedTexel::emissionStraight(const Spot& spot) {
    memory_.queue.clear();
    for (const Look& look : memory_.looks) memory_.queue.push_back(look.ray);
    memory_.roomHits.resize(memory_.queue.size());
    rays_.closest(memory_.queue, memory_.roomHits);
    const std::uint32_t light = room_.sources.images[spot.image].light;
    Vec3 sum(0);
    for (std::size_t k = 0; k < memory_.looks.size(); ++k) {
        const Hit& hit = memory_.roomHits[k];
        if (hit && memory_.looks[k].met < hit.t)
            sum += memory_.looks[k].weight * emissionAt(hit, memory_.queue[k].direction, light);
    }
    return sum;
}

/// What the image would send along it without the object, which is met on the way between the
/// right mirrors; black where another light or another object is met before.
Vec3 ShadowedTexel::emissionAlong(const Look& look, const Spot& spot) const {
    const LightImage& image = room_.sources.images[spot.image];
    Ray ray = look.ray;
    float travelled = 0;
    Vec3 throughput(1);
    for (int k = 0; k < image.depth; ++k) {
        const Hit hit = rays_.closest(ray);
        if (!hit) return Vec3(0);
        const Vec3 n = geometricNormal(scene_, hit.triangle);
        const bool front = glm::dot(n, ray.direction) < 0;
        const TriangleCharts& charts = room_.triangles[hit.triangle].charts;
        if ((front ? charts.front : charts.back) != image.mirror[k]) return Vec3(0);
        travelled += hit.t;
        if (k == spot.object->segment && look.met > travelled) return Vec3(0);
        ray.tMax = hit.t;
        if (k < spot.object->segment && casters_.occluded(ray)) return Vec3(0);
        throughput *= mirrorReflectance(scene_, scene_.material(hit.triangle),
                                        uvAt(scene_, hit.triangle, hit.barycentric));
        const Vec3 side = front ? n : -n;
        ray = {positionAt(scene_, hit.triangle, hit.barycentric) + rays_.epsilon() * side,
               glm::reflect(ray.direction, n)};
    }
    Transmittance passed;
    const Hit hit = image.depth == 0 ? rays_.closestBehindPanes(ray, passed) : rays_.closest(ray);
    if (!hit || (image.depth == spot.object->segment && look.met > travelled + hit.t))
        return Vec3(0);
    return throughput * passed.colour * emissionAt(hit, ray.direction, image.light);
}

Vec3 ShadowedTexel::emissionAt(const Hit& hit, const Vec3& direction, std::uint32_t light) const {
    if (room_.triangles[hit.triangle].light != light) return Vec3(0);
    const bool front = glm::dot(geometricNormal(scene_, hit.triangle), direction) < 0;
    if (front != room_.sources.lights[light].front) return Vec3(0);
    return emittedRadiance(scene_, scene_.material(hit.triangle),
                           uvAt(scene_, hit.triangle, hit.barycentric));
}

}  // namespace vlf
