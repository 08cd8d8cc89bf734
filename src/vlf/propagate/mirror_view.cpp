#include "vlf/propagate/mirror_view.h"

#include "vlf/math/microfacet.h"
#include "vlf/propagate/ray_gather.h"
#include "vlf/propagate/smooth_views.h"
#include "vlf/trace/shadow_ray.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vlf {

namespace {

constexpr float kMinThroughput = 1e-4f;
constexpr float kMinCosine = 0.05f;
constexpr std::size_t kFewLights = 8;
// Of the longest distance: behind all of the scene, and no farther, so that a lookup that follows
// lines of sight through the sky's image does not leave the mirror.
constexpr float kSkyDistance = 0.25f;
constexpr float kGrazing = 1e-4f;
constexpr int kMinReflections = 4;
constexpr float kShared = 0.5f;  // of a cell: closer points show the same in a rough mirror
constexpr float kInset = 1e-3f;  // of the way to the middle of a triangle

/// About the geometric normal `side` where the shading normal would send the ray into the surface.
Vec3 reflectAbove(const Vec3& direction, const Vec3& normal, const Vec3& side) {
    const Vec3 reflected = glm::reflect(direction, normal);
    return glm::dot(reflected, side) > 0 ? reflected : glm::reflect(direction, side);
}

Vec3 sideNormal(const Scene& scene, std::uint32_t triangle, bool front) {
    return geometricNormal(scene, triangle) * (front ? 1.0f : -1.0f);
}

/// The shading normal on the given side; of planar charts the plane's.
Vec3 mirrorNormal(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric,
                  const Vec3& side, bool planar) {
    if (planar) return side;
    const Vec3 normal = shadingNormalAt(scene, triangle, barycentric);
    return glm::dot(normal, side) < 0 ? -normal : normal;
}

/// Mean curvature that a triangle's shading normals give it, positive where they spread.
float curvatureOf(const Scene& scene, std::uint32_t triangle, bool front) {
    const auto& v = scene.triangles[triangle].vertex;
    float spread = 0, extent = 0;
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t a = v[i], b = v[(i + 1) % 3];
        const Vec3 step = scene.positions[b] - scene.positions[a];
        spread += glm::dot(scene.normals[b] - scene.normals[a], step);
        extent += glm::dot(step, step);
    }
    return (front ? spread : -spread) / extent;
}

/// Of weak reflections fewer: there the diffuse light beside them hides more noise.
GlossSamples samplesFor(const GlossSamples& samples, const Vec3& reflectance) {
    const float share = std::min(1.0f, maxComponent(reflectance));
    const auto part = [&](int count, int least) {
        const int some = static_cast<int>(std::ceil(share * static_cast<float>(count)));
        return std::min(count, std::max(least, some));
    };
    return {part(samples.reflections, kMinReflections), part(samples.emitters, 1)};
}

}  // namespace

float imageDistance(float d, float curvature, float cosine, float longest) {
    const float vergence = 1 / d + curvature * (1 / cosine + cosine);
    return vergence * longest > 1 ? 1 / vergence : longest;
}

/// Where a ray has hit the side of a chart.
struct MirrorViewTracer::Arrival {
    const Hit& hit;
    const Chart& chart;
    const Material& material;
    bool front;
    Vec3 position;
    Vec2 uv;
};

void MirrorViewTracer::start(bool planar) {
    views_.assign(cells_.size(), {});
    paths_.clear();
    rayQueue_.clear();
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
        const MirrorCell& c = cells_[i];
        const Vec3 side = sideNormal(scene_, c.triangle, c.front);
        const Vec3 normal = mirrorNormal(scene_, c.triangle, c.barycentric, side, planar);
        const Vec2 uv = uvAt(scene_, c.triangle, c.barycentric);
        const Vec3 mirror = mirrorReflectance(scene_, scene_.material(c.triangle), uv);
        rayQueue_.push_back(
            {c.position + rays_.epsilon() * side, reflectAbove(-toEye_, normal, side)});
        paths_.push_back({i, mirror, 0, true, true, false, 0});
    }
}

/// Of panes the reflected ray, of solids both; what is seen through those decides the distance.
void MirrorViewTracer::startGlass(bool planar) {
    views_.assign(cells_.size(), {});
    paths_.clear();
    rayQueue_.clear();
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
        const MirrorCell& c = cells_[i];
        const Material& glass = scene_.material(c.triangle);
        const Vec3 side = sideNormal(scene_, c.triangle, c.front);
        const Vec3 normal = mirrorNormal(scene_, c.triangle, c.barycentric, side, planar);
        const GlassSplit split = splitAtGlass(glass.medium(), -toEye_, normal, side, c.front);
        const Vec3 position = c.guard && !glass.thin ? pointWithin(c) : c.position;
        rayQueue_.push_back({position + rays_.epsilon() * side, split.reflected});
        paths_.push_back({i, Vec3(split.reflectance), 0, glass.thin, true, false, 0});
        if (glass.thin || split.transmittance <= 0) continue;
        rayQueue_.push_back({position - rays_.epsilon() * side, split.transmitted});
        paths_.push_back({i, split.transmittance * split.radianceScale * glass.transmission, 0,
                          true, false, false, 0});
    }
}

void MirrorViewTracer::passGlass(const Path& path, const Vec3& direction, const Arrival& at) {
    const Vec3 side = sideNormal(scene_, at.hit.triangle, at.front);
    const Vec3 normal =
        mirrorNormal(scene_, at.hit.triangle, at.hit.barycentric, side, at.chart.planar);
    const GlassSplit split =
        splitAtGlass(at.material.medium(), glm::normalize(direction), normal, side, at.front);
    const bool transmits = split.transmittance > split.reflectance;
    followGlass(split, at.material.transmission, path.throughput,
                [&](const Vec3& towards, float offset, const Vec3& weight) {
                    Path next = path;
                    next.throughput *= weight;
                    next.unfolding = path.unfolding && (offset < 0) == transmits;
                    next.first = false;
                    const bool straight = at.material.thin && offset < 0;
                    next.raysPerPoint = straight ? path.raysPerPoint : 0;
                    next.straight = straight ? path.straight + at.hit.t : 0;
                    if (maxComponent(next.throughput) < kMinThroughput) return;
                    nextRays_.push_back({at.position + offset * rays_.epsilon() * side, towards});
                    nextPaths_.push_back(next);
                });
}

/// A point of a rough mirror, seen from somewhere.
struct MirrorViewTracer::RoughPoint {
    Vec3 position, side;  ///< the latter the geometric normal
    Frame frame;          ///< about the shading normal, or the former where that cannot be seen
    Vec3 toEye;           ///< in it
    float roughness;

    RoughPoint(const Vec3& at, const Vec3& geometric, const Vec3& shading, const Vec3& eye,
               float width)
        : position(at),
          side(geometric),
          frame(frameFromNormal(glm::dot(shading, eye) < kMinCosine ? geometric : shading)),
          toEye(frame.toLocal(eye)),
          roughness(width) {
        toEye.z = std::max(toEye.z, kGrazing);
    }
};

void MirrorViewTracer::startRough(float roughness, RandomStream& random) {
    views_.assign(cells_.size(), {});
    distances_.assign(cells_.size(), {});
    nextPaths_.clear();
    nextRays_.clear();
    viewPoints_.clear();
    for (const MirrorCell& c : cells_)
        viewPoints_.push_back({c.guard ? pointWithin(c) : c.position,
                               mirrorNormal(scene_, c.triangle, c.barycentric,
                                            sideNormal(scene_, c.triangle, c.front), false)});
    shownBy_ = firstNearby(viewPoints_, kShared * cellSize_);
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
        if (shownBy_[i] != i) continue;
        const MirrorCell& c = cells_[i];
        const Vec3 side = sideNormal(scene_, c.triangle, c.front);
        const Vec3 mirror = mirrorReflectance(scene_, scene_.material(c.triangle),
                                              uvAt(scene_, c.triangle, c.barycentric));
        const RoughPoint at(viewPoints_[i].position, side, viewPoints_[i].normal, toEye_,
                            roughness);
        scatter({i, mirror, 0, true, true, true, 0}, at, samplesFor(samples_, mirror), random);
    }
    std::swap(paths_, nextPaths_);
    std::swap(rayQueue_, nextRays_);
}

/// Goes on by the lobe of a rough mirror, and looks for emitters by points on them.
void MirrorViewTracer::scatter(Path path, const RoughPoint& at, const GlossSamples& samples,
                               RandomStream& random) {
    const Vec2 shift = random.next2();
    const auto rays = static_cast<float>(samples.reflections);
    const int points = emitters_.empty() ? 0 : samples.emitters;
    const int skies = sky_.hasBright() ? samples.emitters : 0;
    for (int k = 0; k < samples.reflections; ++k) {
        const Vec3 facet =
            sampleGgxNormal(at.roughness, at.toEye, r2Point(static_cast<std::uint32_t>(k), shift));
        const Vec3 local = glm::reflect(-at.toEye, facet);
        const Vec3 direction = at.frame.toWorld(local);
        const float weight = ggxVisible(at.roughness, local);
        if (weight <= 0 || glm::dot(direction, at.side) <= 0) continue;
        nextRays_.push_back({at.position + rays_.epsilon() * at.side, direction});
        Path& next = nextPaths_.emplace_back(path);
        next.throughput *= weight / rays;
        if (points > 0 || skies > 0)
            next.raysPerPoint = rays * ggxDensity(at.roughness, at.toEye, local) /
                                static_cast<float>(samples.emitters);
    }
    for (int k = 0; k < points; ++k) addPoint(path, at, samples, emitters_.sample(random));
    for (int k = 0; k < skies; ++k) addSky(path, at, samples, sky_.sample(random.next2()));
    if (!scene_.lights.empty()) addPunctual(path, at, samples.emitters, random);
}

/// Light of all punctual lights, or of some picked where there are many.
void MirrorViewTracer::addPunctual(const Path& path, const RoughPoint& at, int picks,
                                   RandomStream& random) {
    const float nearest = rays_.epsilon();
    if (scene_.lights.size() <= kFewLights) {
        for (const PunctualLight& light : scene_.lights)
            addBeam(path, at, beamOf(light, at.position, nearest), 1);
        return;
    }
    for (int k = 0; k < picks; ++k) {
        const PickedBeam picked = pickBeam(scene_.lights, at.position, nearest, random.next());
        if (picked.probability > 0)
            addBeam(path, at, picked.beam, 1 / (picked.probability * static_cast<float>(picks)));
    }
}

void MirrorViewTracer::addBeam(const Path& path, const RoughPoint& at, const LightBeam& beam,
                               float weight) {
    if (glm::dot(at.side, beam.toLight) <= 0) return;
    const Vec3 light = path.throughput * beam.irradiance * weight *
                       ggxLobe(at.roughness, at.toEye, at.frame.toLocal(beam.toLight));
    if (!(maxComponent(light) > 0)) return;
    shadowRays_.push_back(
        shadowRay(at.position + rays_.epsilon() * at.side, beam, rays_.epsilon()));
    pointLights_.push_back({path.cell, light});
}

/// Light of the bright part of the environment, by the balance heuristic.
void MirrorViewTracer::addSky(const Path& path, const RoughPoint& at, const GlossSamples& samples,
                              const Sky::Sample& sample) {
    if (glm::dot(at.side, sample.direction) <= 0) return;
    const Vec3 local = at.frame.toLocal(sample.direction);
    const float density =
        static_cast<float>(samples.emitters) * sample.density +
        static_cast<float>(samples.reflections) * ggxDensity(at.roughness, at.toEye, local);
    const Vec3 light =
        path.throughput * sample.bright * (ggxLobe(at.roughness, at.toEye, local) / density);
    if (!(maxComponent(light) > 0)) return;
    shadowRays_.push_back({at.position + rays_.epsilon() * at.side, sample.direction});
    pointLights_.push_back({path.cell, light});
}

/// A ray leaves the scene.
void MirrorViewTracer::leave(const Path& path, const Ray& ray) {
    if (sky_.isBlack()) return;
    Vec3 radiance = sky_.radiance(ray.direction);
    if (path.raysPerPoint > 0 && sky_.hasBright()) {
        const float byLobe = path.raysPerPoint / (path.raysPerPoint + sky_.density(ray.direction));
        radiance -= (1 - byLobe) * sky_.bright(ray.direction);
    }
    views_[path.cell].radiance += path.throughput * glm::max(radiance, Vec3(0));
}

/// Light of a point of an emitter, by the balance heuristic.
void MirrorViewTracer::addPoint(const Path& path, const RoughPoint& at, const GlossSamples& samples,
                                const SidePoint& point) {
    const Vec3 origin = at.position + rays_.epsilon() * at.side;
    const Vec3 to = positionAt(scene_, point.triangle, point.barycentric) - origin;
    const float distance = std::max(glm::length(to), 1e-10f);
    const Vec3 direction = to / distance;
    const float cosine = -glm::dot(geometricNormal(scene_, point.triangle), direction);
    const Material& material = scene_.material(point.triangle);
    if (glm::dot(at.side, direction) <= 0 || (cosine <= 0 && !material.emitsBothSides)) return;
    const Vec3 local = at.frame.toLocal(direction);
    const float density =
        static_cast<float>(samples.emitters) * pointDensity(point.triangle, distance, cosine) +
        static_cast<float>(samples.reflections) * ggxDensity(at.roughness, at.toEye, local);
    const Vec3 light =
        path.throughput * (ggxLobe(at.roughness, at.toEye, local) / density) *
        emittedRadiance(scene_, material, uvAt(scene_, point.triangle, point.barycentric));
    if (maxComponent(light) <= 0) return;
    shadowRays_.push_back({origin, to, 0, 1 - 2 * rays_.epsilon() / distance});
    pointLights_.push_back({path.cell, light});
}

/// Of points on emitters, per steradian.
float MirrorViewTracer::pointDensity(std::uint32_t triangle, float distance, float cosine) const {
    return emitters_.density(triangle) * distance * distance / std::max(std::abs(cosine), kGrazing);
}

/// What of an emitter that a ray has met the points on it leave to it.
float MirrorViewTracer::emitterWeight(const Path& path, const Ray& ray, const Hit& hit) const {
    if (path.raysPerPoint <= 0) return 1;
    const float cosine = glm::dot(geometricNormal(scene_, hit.triangle), ray.direction);
    const float points = pointDensity(hit.triangle, path.straight + hit.t, cosine);
    return path.raysPerPoint / (path.raysPerPoint + points);
}

void MirrorViewTracer::addVisiblePoints() {
    passed_.resize(shadowRays_.size());
    rays_.transmittance(shadowRays_, passed_);
    for (std::size_t i = 0; i < pointLights_.size(); ++i)
        views_[pointLights_[i].cell].radiance += passed_[i] * pointLights_[i].radiance;
    shadowRays_.clear();
    pointLights_.clear();
}

Vec3 MirrorViewTracer::diffuseRadiance(const Arrival& at) const {
    const Vec3 irradiance = field_.atlas.sample(at.chart, at.chart.texelCoordinates(at.position));
    return diffuseReflectance(scene_, at.material, at.uv) * irradiance / kPi;
}

void MirrorViewTracer::reflect(Path path, const Vec3& direction, const Arrival& at,
                               RandomStream& random) {
    const Vec3 mirror = mirrorReflectance(scene_, at.material, at.uv);
    const float chance = path.scattered ? chanceToFollow(mirror) : 1;
    if (chance < 1 && random.next() >= chance) return;
    path.throughput *= mirror / chance;
    if (maxComponent(path.throughput) < kMinThroughput) return;
    path.unfolding = path.unfolding && distances_.empty() && at.chart.planar &&
                     !at.material.isGlossy() &&
                     maxComponent(at.material.mirror) > maxComponent(at.material.diffuse);
    path.first = false;
    path.raysPerPoint = path.straight = 0;
    const Vec3 side = sideNormal(scene_, at.hit.triangle, at.front);
    const Vec3 normal =
        mirrorNormal(scene_, at.hit.triangle, at.hit.barycentric, side, at.chart.planar);
    if (at.material.isGlossy()) {
        const bool again = std::exchange(path.scattered, true);
        scatter(path, {at.position, side, normal, -direction, at.material.roughness},
                again ? GlossSamples{1, 1} : samplesFor(samples_, mirror), random);
        return;
    }
    nextRays_.push_back(
        {at.position + rays_.epsilon() * side, reflectAbove(direction, normal, side)});
    nextPaths_.push_back(path);
}

void MirrorViewTracer::noteDistance(const Path& path, float distance) {
    if (distances_.empty()) {
        views_[path.cell].distance = distance;
    } else {
        distances_[path.cell].inverseSum += 1 / distance;
        ++distances_[path.cell].count;
    }
}

std::uint32_t MirrorViewTracer::chartHit(const Ray& ray, const Hit& hit) const {
    const bool front = glm::dot(areaVector(scene_, hit.triangle), ray.direction) < 0;
    const TriangleCharts& sides = field_.triangleCharts[hit.triangle];
    return front ? sides.front : sides.back;
}

Vec3 MirrorViewTracer::pointWithin(const MirrorCell& cell) const {
    const Vec2 inset = cell.barycentric + kInset * (Vec2(1.0f / 3) - cell.barycentric);
    return positionAt(scene_, cell.triangle, inset);
}

/// Starts a guard cell again from the chart's point next to it.
void MirrorViewTracer::restart(Path path, const Ray& ray) {
    const MirrorCell& cell = cells_[path.cell];
    const Vec3 side = sideNormal(scene_, cell.triangle, cell.front);
    path.first = false;
    nextRays_.push_back({pointWithin(cell) + rays_.epsilon() * side, ray.direction});
    nextPaths_.push_back(path);
}

/// Whether the inside of a solid or the outside of the room comes between p and the eye.
bool MirrorViewTracer::isHidden(const Vec3& p) const {
    const Ray ray{p, toEye_};
    const Hit hit = rays_.closest(ray);
    return hit && chartHit(ray, hit) == kNoChart;
}

void MirrorViewTracer::arrive(const Path& path, const Ray& ray, const Hit& hit,
                              RandomStream& random) {
    const std::uint32_t chart = hit ? chartHit(ray, hit) : kNoChart;
    if (chart == kNoChart && path.first && cells_[path.cell].guard) return restart(path, ray);
    const bool rough = !distances_.empty();
    if (!hit) {
        if (path.unfolding && !rough && path.length == 0 && isHidden(ray.origin)) return;
        if (path.unfolding)
            noteDistance(
                path, sky_.isBlack() ? longest_ : std::max(path.length, kSkyDistance * longest_));
        return leave(path, ray);
    }
    if (chart == kNoChart) return;
    const bool front = glm::dot(areaVector(scene_, hit.triangle), ray.direction) < 0;
    const Arrival at{hit,
                     field_.charts[chart],
                     scene_.material(hit.triangle),
                     front,
                     positionAt(scene_, hit.triangle, hit.barycentric),
                     uvAt(scene_, hit.triangle, hit.barycentric)};
    Path next = path;
    next.length += std::max(hit.t, rays_.epsilon());
    if (path.unfolding) noteDistance(path, next.length);
    Vec3 radiance = diffuseRadiance(at);
    if (at.material.isEmitter() && (at.front || at.material.emitsBothSides))
        radiance += emitterWeight(path, ray, hit) * emittedRadiance(scene_, at.material, at.uv);
    views_[path.cell].radiance += path.throughput * radiance;
    if (at.material.isGlass())
        passGlass(next, ray.direction, at);
    else if (at.material.isMirror())
        reflect(next, ray.direction, at, random);
}

/// What the cells of a rough mirror show, from what those traced do.
void MirrorViewTracer::share() {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        views_[i] = views_[shownBy_[i]];
        const Distances& d = distances_[shownBy_[i]];
        if (d.count > 0) views_[i].distance = static_cast<float>(d.count) / d.inverseSum;
    }
}

void MirrorViewTracer::advance(RandomStream& random) {
    hits_.resize(rayQueue_.size());
    rays_.closest(rayQueue_, hits_);
    nextPaths_.clear();
    nextRays_.clear();
    for (std::size_t i = 0; i < hits_.size(); ++i)
        arrive(paths_[i], rayQueue_[i], hits_[i], random);
    std::swap(paths_, nextPaths_);
    std::swap(rayQueue_, nextRays_);
}

void MirrorViewTracer::formImages() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const MirrorCell& c = cells_[i];
        if (views_[i].distance <= 0) continue;
        const Vec3 side = sideNormal(scene_, c.triangle, c.front);
        const Vec3 normal = mirrorNormal(scene_, c.triangle, c.barycentric, side, false);
        const float cosine = std::max(glm::dot(normal, toEye_), kMinCosine);
        const float curvature = curvatureOf(scene_, c.triangle, c.front);
        views_[i].distance = imageDistance(views_[i].distance, curvature, cosine, longest_);
    }
}

const std::vector<MirrorView>& MirrorViewTracer::trace(std::span<const MirrorCell> cells,
                                                       const Vec3& toEye, bool planar,
                                                       RandomStream& random) {
    cells_ = cells;
    toEye_ = toEye;
    distances_.clear();
    if (cells.empty()) {
        views_.clear();
        return views_;
    }
    const Material& material = scene_.material(cells.front().triangle);
    if (material.isGlossy())
        startRough(material.roughness, random);
    else if (material.isGlass())
        startGlass(planar);
    else
        start(planar);
    for (int step = 0; step <= kMaxReflections && !rayQueue_.empty(); ++step) advance(random);
    addVisiblePoints();
    if (material.isGlossy()) {
        share();
        smoothViews(views_, cells_, viewPoints_, material.roughness, cellSize_);
    }
    if (!planar && material.isSolidGlass())
        for (MirrorView& v : views_) v.distance = std::min(v.distance, cellSize_);
    else if (!planar)
        formImages();
    for (MirrorView& v : views_) v.distance = std::min(v.distance, longest_);
    return views_;
}

}  // namespace vlf
