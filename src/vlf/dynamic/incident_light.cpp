#include "vlf/dynamic/incident_light.h"

#include "vlf/field/direction_set.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/trace/shadow_ray.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr float kInset = 0.02f;  // of the way from a corner's obstacle back to the middle

using Matrix = std::array<std::array<double, kMaxShCount>, kMaxShCount>;

/// Lower triangle of the Cholesky factor of a symmetric positive definite matrix, in place.
void factorise(Matrix& m) {
    for (int i = 0; i < kMaxShCount; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = m[i][j];
            for (int k = 0; k < j; ++k) sum -= m[i][k] * m[j][k];
            m[i][j] = i == j ? std::sqrt(sum) : sum / m[j][j];
        }
}

/// x of L Lᵀ x = b.
Sh<float> solve(const Matrix& l, const Sh<float>& b) {
    std::array<double, kMaxShCount> x{};
    for (int i = 0; i < kMaxShCount; ++i) {
        x[i] = b[i];
        for (int k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
        x[i] /= l[i][i];
    }
    for (int i = kMaxShCount; i-- > 0;) {
        for (int k = i + 1; k < kMaxShCount; ++k) x[i] -= l[k][i] * x[k];
        x[i] /= l[i][i];
    }
    Sh<float> result;
    for (int i = 0; i < kMaxShCount; ++i) result[i] = static_cast<float>(x[i]);
    return result;
}

/// What values at `directions` count in each coefficient of the function that fits them best, in
/// the mean square over the sphere: constant radiance gives itself, which plain sums do not.
std::vector<Sh<float>> fittingWeights(const std::vector<Vec3>& directions,
                                      const std::vector<float>& solidAngles) {
    std::vector<Sh<float>> weights;
    Matrix gram{};
    for (std::size_t d = 0; d < directions.size(); ++d) {
        Sh<float> basis = shBasis(directions[d]);
        for (int i = 0; i < kMaxShCount; ++i)
            for (int j = 0; j <= i; ++j)
                gram[i][j] += static_cast<double>(solidAngles[d]) * basis[i] * basis[j];
        for (float& b : basis) b *= solidAngles[d];
        weights.push_back(basis);
    }
    factorise(gram);
    for (Sh<float>& w : weights) w = solve(gram, w);
    return weights;
}

/// Distance from p along d (not unit) to where the way leaves the box; p lies in it.
float exitDistance(const Bounds& box, const Vec3& p, const Vec3& d) {
    float exit = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis)
        if (d[axis] != 0)
            exit = std::min(
                exit, ((d[axis] > 0 ? box.upper[axis] : box.lower[axis]) - p[axis]) / d[axis]);
    return std::max(exit, 0.0f);
}

/// The parts of the rays outside the object's own box, which holds their origins and may touch the
/// object.
void startOutside(std::span<Ray> rays, Bounds box, const Pose& pose) {
    const Vec3 margin(1e-3f * glm::length(box.size()));
    box.lower -= margin, box.upper += margin;
    for (Ray& ray : rays)
        ray.tMin = exitDistance(box, pose.inversePoint(ray.origin),
                                pose.inverseDirection(ray.direction) / pose.scale);
}

Vec3 radianceOf(const InstanceHit& found, const Vec3& direction, std::span<const LitObject> lit) {
    const LitObject& object = lit[found.instance];
    const Scene& scene = object.mesh->scene;
    Sight sight;
    sight.object = found.instance;
    sight.triangle = found.hit.triangle;
    sight.barycentric = found.hit.barycentric;
    sight.front = glm::dot(object.pose.direction(areaVector(scene, sight.triangle)), direction) < 0;
    Vec3 radiance = diffuseRadiance(sight, {}, lit);
    const Material& material = scene.material(sight.triangle);
    if (sight.front || material.emitsBothSides)
        radiance +=
            emittedRadiance(scene, material, uvAt(scene, sight.triangle, sight.barycentric));
    return radiance;
}

/// Beams that stand for the bright part of a sky.
std::vector<LightBeam> skyBeams(const Sky& sky, int count, const Vec2& shift) {
    std::vector<LightBeam> beams;
    for (int k = 0; k < count; ++k) {
        const Sky::Sample sample = sky.sample(r2Point(static_cast<std::uint32_t>(k), shift));
        if (!(sample.density > 0)) continue;
        LightBeam beam;
        beam.toLight = sample.direction;
        beam.irradiance = sample.bright / (sample.density * static_cast<float>(count));
        beams.push_back(beam);
    }
    return beams;
}

bool any(const SightObjects* objects) {
    return objects && objects->rays && !objects->rays->empty();
}

}  // namespace

void applyTransfer(const PrtTransfer& transfer, const IncidentLight& light,
                   std::span<Vec3> irradiance) {
    if (light.uniform)
        applyTransfer(transfer, light.corners[0], irradiance);
    else
        applyTransfer(transfer, light.corners, irradiance);
}

IncidentLightFinder::IncidentLightFinder(const Scene& scene, const RayScene& rays,
                                         const RoomTexels& room, const IncidentSettings& settings)
    : scene_(scene),
      rays_(rays),
      room_(room),
      largeRadius_(settings.largeFrom * room.frame.radius),
      emitters_(settings.emitters),
      middle_(makePattern(scene, room.sources, settings.lines, settings.emitterPoints, 0)) {
    for (int i = 0; i < 8; ++i)
        corners_[static_cast<std::size_t>(i)] =
            makePattern(scene, room.sources, settings.cornerLines, settings.cornerEmitterPoints, i);
}

/// Each turned its own way: what too few directions get wrong is not the same at all corners.
IncidentLightFinder::Pattern IncidentLightFinder::makePattern(const Scene& scene,
                                                              const LightSources& sources,
                                                              int lines, int emitterPoints,
                                                              int number) {
    Pattern pattern;
    const DirectionSet set(lines);
    RandomStream random(11, static_cast<std::uint64_t>(number));
    const Vec2 u = random.next2();
    const Mat3 turn = sampleUniformRotation({u.x, u.y, random.next()});
    std::vector<float> solidAngles;
    for (int i = 0; i < set.directionCount(); ++i) {
        const auto d = static_cast<std::uint32_t>(i);
        pattern.directions.push_back(turn * set.direction(d));
        solidAngles.push_back(set.weight(d));
    }
    pattern.weights = fittingWeights(pattern.directions, solidAngles);
    pattern.emitters = spreadPoints(scene, sources, emitterPoints, number);
    if (sources.sky && sources.sky->sky.hasBright())
        pattern.sky = skyBeams(sources.sky->sky, emitterPoints, random.next2());
    return pattern;
}

/// What is seen along scratch.rays, into scratch.seen.
void IncidentLightFinder::look(const Pattern& pattern, std::span<const Vec3> radiance,
                               const Body& body, Scratch& scratch) const {
    scratch.seen.assign(pattern.directions.size(), Vec3(0));
    if (any(body.others)) {
        startOutside(scratch.rays, *body.box, *body.pose);
        scratch.hits.resize(scratch.rays.size());
        body.others->rays->closest(scratch.rays, scratch.hits);
        for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
            scratch.rays[i].tMin = 0;
            if (scratch.hits[i]) scratch.rays[i].tMax = scratch.hits[i].hit.t;
        }
    } else {
        scratch.hits.clear();
    }
    const bool allImages = emitters_ == IncidentEmitters::none || pattern.emitters.withImages;
    scratch.tracer.trace(scratch.rays, scratch.sights);
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        if (scratch.sights.texel[i] == kNoTexel) continue;
        scratch.seen[i] = radiance[scratch.sights.texel[i]];
        if (!scratch.hits.empty()) scratch.hits[i] = {};
    }
    for (const Sight& sight : scratch.sights.others) {
        const bool sky = sight.triangle == kNoTriangle;
        const bool apart =
            sight.emissionApart &&
            (sky || (emitters_ != IncidentEmitters::met && (allImages || !sight.inMirror)));
        Vec3 light = diffuseRadiance(sight, radiance, {});
        if (!apart) light += sight.emission;
        scratch.seen[sight.ray] += sight.throughput * light;
        if (!scratch.hits.empty()) scratch.hits[sight.ray] = {};
    }
    for (std::size_t i = 0; i < scratch.hits.size(); ++i)
        if (scratch.hits[i])
            scratch.seen[i] =
                radianceOf(scratch.hits[i], scratch.rays[i].direction, body.others->lit);
}

/// What emitters and their images in mirrors send, straight to the point.
void IncidentLightFinder::addEmitters(const Vec3& point, const Pattern& pattern, const Body& body,
                                      Scratch& scratch, Sh<Vec3>& light) const {
    const EmitterPoints& emitters = pattern.emitters;
    scratch.solidAngles.resize(emitters.points.size());
    scratch.rays.clear(), scratch.points.clear();
    const auto add = [&](std::uint32_t p, const Vec3& throughput) {
        const EmitterPoint& emitter = emitters.points[p];
        const Sh<float> basis = shBasis(glm::normalize(emitter.position - point));
        const Vec3 power = scratch.solidAngles[p] * throughput * emitter.radiance;
        for (int f = 0; f < kMaxShCount; ++f) light[f] += basis[f] * power;
    };
    for (const EmitterShare& share : emitters.shares) {
        solidAngles(emitters, share, point,
                    std::span(scratch.solidAngles).subspan(share.first, share.count));
        const LightImage& image = room_.sources.images[share.image];
        for (std::uint32_t p = share.first; p < share.first + share.count; ++p) {
            if (scratch.solidAngles[p] <= 0) continue;
            const EmitterPoint& emitter = emitters.points[p];
            if (image.depth == 0) {
                const Vec3 target = emitter.position + rays_.epsilon() * emitter.normal;
                scratch.rays.push_back({point, target - point, 0, 1});
                scratch.points.push_back(p);
            } else if (Vec3 throughput(1); isSeenOverMirrors(point, emitter, image, throughput)) {
                add(p, throughput);
            }
        }
    }
    findPassed(body, scratch);
    for (std::size_t i = 0; i < scratch.rays.size(); ++i)
        if (!scratch.blocked[i]) add(scratch.points[i], scratch.passed[i]);
}

/// Which of scratch.rays something is in the way of, and what panes let pass of the others.
void IncidentLightFinder::findPassed(const Body& body, Scratch& scratch) const {
    scratch.passed.resize(scratch.rays.size());
    rays_.transmittance(scratch.rays, scratch.passed);
    scratch.blocked.clear();
    for (const Vec3& passed : scratch.passed) scratch.blocked.push_back(passed == Vec3(0));
    if (any(body.others)) {
        startOutside(scratch.rays, *body.box, *body.pose);
        scratch.blockedByObjects.resize(scratch.rays.size());
        body.others->rays->occluded(scratch.rays, scratch.blockedByObjects);
        for (std::size_t i = 0; i < scratch.rays.size(); ++i)
            scratch.blocked[i] |= scratch.blockedByObjects[i];
    }
}

/// What punctual lights and the bright part of the sky send, straight to the point.
void IncidentLightFinder::addBeams(const Vec3& point, const Pattern& pattern, const Body& body,
                                   Scratch& scratch, Sh<Vec3>& light) const {
    scratch.beams = pattern.sky;
    for (const PunctualLight& punctual : room_.sources.punctual)
        scratch.beams.push_back(beamOf(punctual, point, rays_.epsilon()));
    if (scratch.beams.empty()) return;
    scratch.rays.clear();
    for (const LightBeam& beam : scratch.beams)
        scratch.rays.push_back(shadowRay(point, beam, rays_.epsilon()));
    findPassed(body, scratch);
    for (std::size_t i = 0; i < scratch.beams.size(); ++i) {
        if (scratch.blocked[i]) continue;
        const Sh<float> basis = shBasis(scratch.beams[i].toLight);
        for (int f = 0; f < kMaxShCount; ++f)
            light[f] += basis[f] * scratch.passed[i] * scratch.beams[i].irradiance;
    }
}

/// Whether the way to the image meets exactly its mirrors, whose reflectances it is multiplied by.
bool IncidentLightFinder::isSeenOverMirrors(const Vec3& point, const EmitterPoint& emitter,
                                            const LightImage& image, Vec3& throughput) const {
    Vec3 origin = point, direction = glm::normalize(emitter.position - point);
    for (int k = 0; k < image.depth; ++k) {
        const Hit hit = rays_.closest({origin, direction});
        if (!hit) return false;
        const RoomTriangle& triangle = room_.triangles[hit.triangle];
        const bool front = glm::dot(triangle.areaVector, direction) < 0;
        if ((front ? triangle.charts.front : triangle.charts.back) != image.mirror[k]) return false;
        throughput *= mirrorReflectance(scene_, scene_.material(hit.triangle),
                                        uvAt(scene_, hit.triangle, hit.barycentric));
        const Vec3 normal = (front ? 1.0f : -1.0f) * geometricNormal(scene_, hit.triangle);
        origin += hit.t * direction + rays_.epsilon() * normal;
        direction = glm::reflect(direction, normal);
    }
    const Vec3 way = emitter.emitter - origin;
    return !rays_.occluded({origin, way, 0, 1 - 2 * rays_.epsilon() / glm::length(way)});
}

Sh<Vec3> IncidentLightFinder::sample(const Vec3& point, const Pattern& pattern,
                                     std::span<const Vec3> radiance, const Body& body,
                                     Scratch& scratch) const {
    scratch.rays.clear();
    for (const Vec3& d : pattern.directions) scratch.rays.push_back({point, d});
    look(pattern, radiance, body, scratch);
    Sh<Vec3> light{};
    for (std::size_t i = 0; i < pattern.directions.size(); ++i)
        for (int f = 0; f < kMaxShCount; ++f) light[f] += pattern.weights[i][f] * scratch.seen[i];
    if (emitters_ == IncidentEmitters::sampled) addEmitters(point, pattern, body, scratch, light);
    if (emitters_ != IncidentEmitters::none) addBeams(point, pattern, body, scratch, light);
    return light;
}

/// Of the box, but on this side of what the room has between its middle and there.
Vec3 IncidentLightFinder::cornerPoint(const Bounds& box, const Pose& pose, int corner) const {
    const Vec3 centre = pose.point(box.centre());
    const Vec3 place(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                     corner & 4 ? box.upper.z : box.lower.z);
    const Ray ray{centre, pose.point(place) - centre, 0, 1 + kInset};
    const Hit hit = rays_.closest(ray);
    return centre + (hit ? std::max(hit.t - kInset, 0.0f) : 1.0f) * ray.direction;
}

void IncidentLightFinder::find(const Bounds& box, const Pose& pose, std::span<const Vec3> radiance,
                               const SightObjects& others, Scratch& scratch,
                               IncidentLight& light) const {
    const Body body{&box, &pose, &others};
    const Quat toObject = glm::conjugate(pose.rotation);
    light.uniform = 0.5f * pose.scale * glm::length(box.size()) < largeRadius_;
    if (light.uniform) {
        light.corners[0] =
            rotateSh(sample(pose.point(box.centre()), middle_, radiance, body, scratch), toObject);
        return;
    }
    for (int i = 0; i < 8; ++i) {
        const auto c = static_cast<std::size_t>(i);
        light.corners[c] = rotateSh(
            sample(cornerPoint(box, pose, i), corners_[c], radiance, body, scratch), toObject);
    }
}

Sh<Vec3> IncidentLightFinder::at(const Vec3& point, std::span<const Vec3> radiance,
                                 Scratch& scratch) const {
    return sample(point, middle_, radiance, {}, scratch);
}

}  // namespace vlf
