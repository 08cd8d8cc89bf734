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
                             std::span<const MayHide> shadows, const ShadowSampling& sampling)
    : scene_(scene),
      rays_(rays),
      room_(room),
      casters_(casters),
      obstructions_(obstructions),
      shadows_(shadows),
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
    for (std::size_t first = 0, end = 0; first < shadows_.size(); first = end) {
        while (end < shadows_.size() && shadows_[end].image == shadows_[first].image) ++end;
        sort(receiver, shadows_.subspan(first, end - first));
    }
}

void ShadowedTexel::sort(const LightReceiver& receiver, std::span<const MayHide> ofImage) {
    const std::uint32_t i = ofImage[0].image;
    const LightImage& image = room_.sources.images[i];
    const Light& light = room_.sources.lights[image.light];
    float effect = -1;  // not known yet
    const Vec3 way = obstructions_.of(i).light.centre - receiver.centre;
    const float seen = light.area / std::max(glm::dot(way, way), 1e-20f);
    const float radiance = luminance(light.radiance * image.throughput);
    const std::size_t before = memory_.spots.size();
    for (const MayHide& shadow : ofImage) {
        const Obstruction::Object& object = *shadow.object;
        if (!obstructions_.mayHide(receiver, i, object)) continue;
        if (effect < 0) effect = gatherer_.likelyEffect(receiver, image);
        if (effect <= kNothing * sampling_.slight) return;
        const float angle = solidAngleOf(receiver.centre, object.sphere);
        const bool larger = light.kind == LightKind::surface && seen > kLarger * angle;
        const float taken = larger ? std::min(effect, radiance * angle) : effect;
        if (taken <= kNothing * sampling_.slight) continue;
        if (!larger) {
            memory_.sampled[i] = anySampled_ = true;
            memory_.spots.resize(before);
            return;
        }
        memory_.spots.push_back({i, &object, stepFor(taken)});
    }
}

void ShadowedTexel::findPoints(const LightReceiver& r) {
    memory_.points.clear();
    std::uint32_t triangle = kNoTriangle;
    Vec3 geometric(0);
    for (const SurfacePoint& p : r.points) {
        if (p.triangle != triangle) geometric = r.side * geometricNormal(*r.scene, p.triangle);
        triangle = p.triangle;
        const Vec3 shading = shadingNormalAt(*r.scene, p.triangle, p.barycentric);
        memory_.points.push_back({positionAt(*r.scene, p.triangle, p.barycentric),
                                  glm::dot(shading, geometric) < 0 ? -shading : shading,
                                  geometric});
    }
}

/// Irradiance from an image that an object hides: what it would send along all looks without the
/// object, which is met on the way between the right mirrors; black where another light or another
/// object is met before.
Vec3 ShadowedTexel::behind(const Spot& spot) {
    const LightImage& image = room_.sources.images[spot.image];
    aim(spot);
    keepThoseThatMeet(spot);
    for (int k = 0; k < image.depth; ++k) reflect(spot, k);
    if (image.depth == 0 && rays_.hasPanes())
        findHitsBehindPanes();
    else
        findHits();
    Vec3 sum(0);
    for (std::size_t k = 0; k < memory_.looks.size(); ++k) {
        const Look& look = memory_.looks[k];
        const Hit& hit = memory_.roomHits[k];
        if (hit && (image.depth > spot.object->segment || look.met <= hit.t))
            sum += look.weight * look.throughput * emissionAt(hit, look.ray.direction, image.light);
    }
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
    const auto points = foldedPoints(spot);
    memory_.looks.clear();
    std::size_t at = 0;
    for (std::size_t k = step / 2; k < patches.size(); k += step, ++at) {
        if (at == points.size()) at = 0;
        const Point& p = points[at];
        const Vec3 way = patches[k].position - p.position;
        float facing = -glm::dot(way, patches[k].normal);
        if (!closed) facing = std::abs(facing);
        const float above = glm::dot(p.shading, way);
        if (!(facing > 0) || !(above > 0) || glm::dot(p.geometric, way) <= 0) continue;
        const Point& real = memory_.points[at];
        const Vec3 origin = real.position + rays_.epsilon() * real.geometric;
        const Vec3 unfolded = obstructions_.unfoldDirection(way, spot.image, segment);
        if (!plane.mayBeMet(origin, unfolded)) continue;
        const float squared = glm::dot(way, way), distance = std::sqrt(squared);
        Look& look = memory_.looks.emplace_back();  // in place: copying one stalls
        look.ray.origin = origin;
        look.ray.direction = unfolded / distance;
        look.weight =
            above * facing * area / (receiverLobe(p.shading, p.geometric) * squared * squared);
        look.met = distance;
    }
}

/// The texel's points as the object has them before it, behind mirrors or not.
std::span<const ShadowedTexel::Point> ShadowedTexel::foldedPoints(const Spot& spot) {
    const int segment = spot.object->segment;
    if (segment == 0) return memory_.points;
    memory_.folded.clear();
    for (const Point& p : memory_.points)
        memory_.folded.push_back({obstructions_.fold(p.position, spot.image, segment),
                                  obstructions_.foldDirection(p.shading, spot.image, segment),
                                  obstructions_.foldDirection(p.geometric, spot.image, segment)});
    return memory_.folded;
}

/// Their patch, and nothing else of the objects before it; from where it is seen behind mirrors.
void ShadowedTexel::keepThoseThatMeet(const Spot& spot) {
    const int segment = spot.object->segment;
    if (obstructions_.casterCount() == 1 && obstructions_.caster(0).model->convex()) return;
    memory_.queue.clear();
    for (const Look& look : memory_.looks)
        memory_.queue.push_back(
            {obstructions_.fold(look.ray.origin, spot.image, segment),
             obstructions_.foldDirection(look.ray.direction, spot.image, segment)});
    memory_.hits.resize(memory_.queue.size());
    casters_.closest(memory_.queue, memory_.hits);
    const float reach = kSameDistance * spot.object->sphere.radius + 4 * rays_.epsilon();
    keepLooks([&](const Look& look, std::size_t k) {
        const InstanceHit& found = memory_.hits[k];
        return found && found.instance == spot.object->number &&
               std::abs(found.hit.t - look.met) < reach;
    });
}

/// Of the looks those for which keep(look, number) is true.
template <class Keep>
void ShadowedTexel::keepLooks(Keep keep) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < memory_.looks.size(); ++k)
        if (keep(memory_.looks[k], k)) memory_.looks[kept++] = memory_.looks[k];
    memory_.looks.resize(kept);
}

/// What they meet of the room.
void ShadowedTexel::findHits() {
    memory_.queue.clear();
    for (const Look& look : memory_.looks) memory_.queue.push_back(look.ray);
    memory_.roomHits.resize(memory_.queue.size());
    rays_.closest(memory_.queue, memory_.roomHits);
}

void ShadowedTexel::findHitsBehindPanes() {
    memory_.roomHits.clear();
    for (Look& look : memory_.looks) {
        Transmittance passed;
        memory_.roomHits.push_back(rays_.closestBehindPanes(look.ray, passed));
        look.throughput *= passed.colour;
    }
}

/// Goes on with those that meet a mirror of the image, behind the object if that is before it.
void ShadowedTexel::reflect(const Spot& spot, int mirror) {
    const std::uint32_t chart = room_.sources.images[spot.image].mirror[mirror];
    const int segment = spot.object->segment;
    findHits();
    for (std::size_t k = 0; k < memory_.queue.size(); ++k)
        memory_.queue[k].tMax = memory_.roomHits[k].t;
    memory_.blocked.assign(memory_.queue.size(), 0);
    if (mirror < segment) casters_.occluded(memory_.queue, memory_.blocked);
    keepLooks([&](Look& look, std::size_t k) {
        const Hit& hit = memory_.roomHits[k];
        if (!hit || memory_.blocked[k] || (mirror == segment && look.met > hit.t)) return false;
        const Vec3 n = geometricNormal(scene_, hit.triangle);
        const bool front = glm::dot(n, look.ray.direction) < 0;
        const TriangleCharts& charts = room_.triangles[hit.triangle].charts;
        if ((front ? charts.front : charts.back) != chart) return false;
        look.met -= hit.t;
        look.throughput *= mirrorReflectance(scene_, scene_.material(hit.triangle),
                                             uvAt(scene_, hit.triangle, hit.barycentric));
        look.ray = {
            positionAt(scene_, hit.triangle, hit.barycentric) + rays_.epsilon() * (front ? n : -n),
            glm::reflect(look.ray.direction, n)};
        return true;
    });
}

Vec3 ShadowedTexel::emissionAt(const Hit& hit, const Vec3& direction, std::uint32_t light) const {
    const RoomTriangle& triangle = room_.triangles[hit.triangle];
    if (triangle.light != light) return Vec3(0);
    const bool front = glm::dot(triangle.areaVector, direction) < 0;
    if (front != room_.sources.lights[light].front) return Vec3(0);
    return emittedRadiance(scene_, scene_.material(hit.triangle),
                           uvAt(scene_, hit.triangle, hit.barycentric));
}

}  // namespace vlf
