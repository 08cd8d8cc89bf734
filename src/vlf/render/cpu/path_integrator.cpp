#include "vlf/render/cpu/path_integrator.h"

#include "vlf/trace/shadow_ray.h"

#include <algorithm>

namespace vlf {

namespace {

/// Paths of this many segments and more are continued by chance.
constexpr int kRouletteDepth = 4;

/// As many punctual lights are all asked at every point; of more, one is picked.
constexpr std::size_t kFewLights = 4;

/// Keeps paths between perfect mirrors finite.
constexpr float kMaxSurvival = 0.97f;

/// Weight of a sample drawn with density p where another technique has density q (power
/// heuristic, exponent 2). p may be infinite: a direction that only this technique can draw.
float powerHeuristic(float p, float q) {
    const float ratio = q / p;
    return 1 / (1 + ratio * ratio);
}

/// Ends paths by chance in proportion to what they can still carry.
bool survivesRoulette(Vec3& throughput, RandomStream& random) {
    const float chance = std::min(kMaxSurvival, maxComponent(throughput));
    if (random.next() >= chance) return false;
    throughput /= chance;
    return true;
}

}  // namespace

struct PathIntegrator::Path {
    Ray ray;
    Vec3 throughput{1};
    float density = kCertain;  ///< with which a lobe drew ray.direction, per steradian
    int depth = 1;             ///< segments, that of `ray` included; panes passed do not end one
    float straight = 0;        ///< of the segment, metres before `ray`
    Hit hit{};                 ///< of `ray`
};

PathIntegrator::PathIntegrator(const Scene& scene, const RayScene& rays, const PathOptions& options)
    : scene_(scene),
      rays_(rays),
      options_(options),
      emitters_(scene),
      sky_(scene.environment, meanLuminance(scene.environment)) {}

Vec3 PathIntegrator::radiance(const Ray& ray, RandomStream& random) const {
    Path path{ray};
    path.hit = rays_.closest(ray);
    return followPath(path, random);
}

std::optional<Vec3> PathIntegrator::irradiance(const SidePoint& point, const SideIsOpen& isOpen,
                                               RandomStream& random) const {
    // Irradiance is π times the radiance that a white Lambertian surface in its place reflects.
    Surface white = surfaceAt(scene_, point);
    white.diffuse = Vec3(1);
    white.mirror = Vec3(0);
    const Scattering scattering(white, white.normal);
    Path path;
    if (!scatter(white, scattering, path, random)) return Vec3(0);
    path.depth = 1;
    path.hit = rays_.closest(path.ray);
    if (path.hit) {
        const SidePoint seen = pointFacing(scene_, path.hit, path.ray.direction);
        if (!isOpen(seen.triangle, seen.front)) return std::nullopt;
    }
    const Vec3 direct = directLight(white, scattering, random);
    return kPi * (direct + followPath(path, random));
}

Vec3 PathIntegrator::followPath(Path path, RandomStream& random) const {
    Vec3 radiance(0);
    for (;;) {
        if (!path.hit) return radiance + path.throughput * skySeen(path);
        const SidePoint point = pointFacing(scene_, path.hit, path.ray.direction);
        radiance += path.throughput * emitterSeen(path, point);
        if (scene_.material(point.triangle).isGlass()) {
            if (!passGlass(point, path, random)) break;
            path.hit = rays_.closest(path.ray);
            continue;
        }
        if (path.depth == options_.maxDepth) break;
        const Surface surface = surfaceAt(scene_, point);
        if (!surface.reflects()) break;
        const Scattering scattering(surface, -path.ray.direction);
        radiance += path.throughput * directLight(surface, scattering, random);
        if (!scatter(surface, scattering, path, random)) break;
        if (path.depth >= kRouletteDepth && !survivesRoulette(path.throughput, random)) break;
        path.hit = rays_.closest(path.ray);
    }
    return radiance;
}

/// By the lobes all of the environment can be met, by its brightness what is above the mean.
Vec3 PathIntegrator::skySeen(const Path& path) const {
    const Vec3 radiance = sky_.radiance(path.ray.direction);
    if (!options_.sampleEmitters || path.density == kCertain || !sky_.hasBright()) return radiance;
    return radiance * powerHeuristic(path.density, sky_.density(path.ray.direction));
}

Vec3 PathIntegrator::emitterSeen(const Path& path, const SidePoint& point) const {
    const Vec3 emission = emittedRadiance(scene_, point);
    if (!options_.sampleEmitters || path.density == kCertain || emission == Vec3(0))
        return emission;
    const float cosine =
        std::abs(glm::dot(geometricNormal(scene_, point.triangle), path.ray.direction));
    const float distance = path.straight + path.hit.t;
    const float density = emitters_.density(point.triangle) * distance * distance / cosine;
    return emission * powerHeuristic(path.density, density);
}

Vec3 PathIntegrator::directLight(const Surface& surface, const Scattering& scattering,
                                 RandomStream& random) const {
    if (!scattering.hasLobes()) return Vec3(0);
    Vec3 light = punctualLight(surface, scattering, random);
    if (!options_.sampleEmitters) return light;
    light += emitterLight(surface, scattering, random);
    return light + skyLight(surface, scattering, random);
}

Vec3 PathIntegrator::punctualLight(const Surface& surface, const Scattering& scattering,
                                   RandomStream& random) const {
    const std::vector<PunctualLight>& lights = scene_.lights;
    if (lights.empty()) return Vec3(0);
    if (lights.size() > kFewLights) {
        const PickedBeam picked =
            pickBeam(lights, surface.position, rays_.epsilon(), random.next());
        if (!(picked.probability > 0)) return Vec3(0);
        return beamLight(surface, scattering, picked.beam) / picked.probability;
    }
    Vec3 sum(0);
    for (const PunctualLight& light : lights)
        sum += beamLight(surface, scattering, beamOf(light, surface.position, rays_.epsilon()));
    return sum;
}

Vec3 PathIntegrator::beamLight(const Surface& surface, const Scattering& scattering,
                               const LightBeam& beam) const {
    const Vec3 light = scattering.lobes(beam.toLight) * beam.irradiance;
    if (!(maxComponent(light) > 0)) return Vec3(0);
    const Vec3 origin = surface.position + rays_.epsilon() * surface.geometricNormal;
    return light * rays_.transmittance(shadowRay(origin, beam, rays_.epsilon())).colour;
}

Vec3 PathIntegrator::skyLight(const Surface& surface, const Scattering& scattering,
                              RandomStream& random) const {
    if (!sky_.hasBright()) return Vec3(0);
    const Sky::Sample sample = sky_.sample(random.next2());
    const Vec3 lobes = scattering.lobes(sample.direction);
    if (maxComponent(lobes) <= 0 || !(sample.density > 0)) return Vec3(0);
    const Transmittance passed = rays_.transmittance(rayFrom(surface, sample.direction));
    const float byChance = scattering.density(sample.direction) * passed.chance;
    const float weight = powerHeuristic(sample.density, byChance);
    return lobes * sky_.radiance(sample.direction) * passed.colour * (weight / sample.density);
}

Vec3 PathIntegrator::emitterLight(const Surface& surface, const Scattering& scattering,
                                  RandomStream& random) const {
    if (emitters_.empty()) return Vec3(0);
    SidePoint point = emitters_.sample(random);
    Surface emitter = surfaceAt(scene_, point);
    const Vec3 between = emitter.position - surface.position;
    const float distance2 = glm::dot(between, between);
    const Vec3 direction = between / std::sqrt(distance2);
    if (!(distance2 > 0)) return Vec3(0);
    const Vec3 lobes = scattering.lobes(direction);
    if (maxComponent(lobes) <= 0) return Vec3(0);
    if (glm::dot(emitter.geometricNormal, direction) > 0) {
        point.front = false;
        emitter.geometricNormal = -emitter.geometricNormal;
    }
    const Vec3 emission = emittedRadiance(scene_, point);
    if (emission == Vec3(0)) return Vec3(0);
    const Transmittance passed = visible(surface, emitter);
    if (passed.colour == Vec3(0)) return Vec3(0);
    const float density = emitters_.density(point.triangle) * distance2 /
                          -glm::dot(emitter.geometricNormal, direction);
    const float byChance = scattering.density(direction) * passed.chance;
    return lobes * emission * passed.colour * (powerHeuristic(density, byChance) / density);
}

/// False where the path ends in the surface.
bool PathIntegrator::scatter(const Surface& surface, const Scattering& scattering, Path& path,
                             RandomStream& random) const {
    const auto sample = scattering.sample(random);
    if (!sample) return false;
    ++path.depth;
    path.throughput *= sample->weight;
    path.density = sample->density;
    path.ray = rayFrom(surface, sample->direction);
    path.straight = 0;
    return true;
}

/// Goes on by reflection or transmission, drawn by Fresnel's law. Panes are passed straight, which
/// the light sampled at the last surface has, too: only the chance of passing is noted. False where
/// the path ends.
bool PathIntegrator::passGlass(const SidePoint& point, Path& path, RandomStream& random) const {
    const Surface surface = surfaceAt(scene_, point);
    const Material& glass = scene_.material(point.triangle);
    const GlassSplit split = splitAtGlass(glass.medium(), path.ray.direction, surface.normal,
                                          surface.geometricNormal, point.front);
    const Vec3 offset = rays_.epsilon() * surface.geometricNormal;
    const bool reflects = random.next() < split.reflectance;
    if (!reflects) path.throughput *= split.radianceScale * glass.transmission;
    if (!reflects && glass.thin) {
        path.straight += path.hit.t;
        path.density *= split.transmittance;
        path.ray = {surface.position - offset, path.ray.direction};
        return maxComponent(path.throughput) > 0;
    }
    if (path.depth == options_.maxDepth) return false;
    path.ray = reflects ? Ray{surface.position + offset, split.reflected}
                        : Ray{surface.position - offset, split.transmitted};
    path.density = kCertain;
    path.straight = 0;
    return ++path.depth < kRouletteDepth || survivesRoulette(path.throughput, random);
}

Ray PathIntegrator::rayFrom(const Surface& surface, const Vec3& direction) const {
    return {surface.position + rays_.epsilon() * surface.geometricNormal, direction};
}

Transmittance PathIntegrator::visible(const Surface& surface, const Surface& emitter) const {
    const Vec3 from = surface.position + rays_.epsilon() * surface.geometricNormal;
    const Vec3 to = emitter.position + rays_.epsilon() * emitter.geometricNormal;
    return rays_.transmittance({from, to - from, 0, 1});
}

}  // namespace vlf
