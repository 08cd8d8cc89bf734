#include "vlf/render/cpu/path_integrator.h"

#include <algorithm>

namespace vlf {

namespace {

/// Paths of this many segments and more are continued by chance.
constexpr int kRouletteDepth = 4;

/// Keeps paths between perfect mirrors finite.
constexpr float kMaxSurvival = 0.97f;

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
    : scene_(scene), rays_(rays), options_(options), lamps_(scene, rays) {}

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

/// Density by which light is weighted that the path meets.
float PathIntegrator::rivalDensity(const Path& path) const {
    return options_.sampleEmitters ? path.density : kCertain;
}

Vec3 PathIntegrator::skySeen(const Path& path) const {
    const Vec3& direction = path.ray.direction;
    return lamps_.skyRadiance(direction) * lamps_.weightOfSky(direction, rivalDensity(path));
}

Vec3 PathIntegrator::emitterSeen(const Path& path, const SidePoint& point) const {
    const Vec3 emission = emittedRadiance(scene_, point);
    if (emission == Vec3(0)) return emission;
    return emission * lamps_.weightOfEmitter(point, path.ray.direction, path.straight + path.hit.t,
                                             rivalDensity(path));
}

Vec3 PathIntegrator::directLight(const Surface& surface, const Scattering& scattering,
                                 RandomStream& random) const {
    if (!scattering.hasLobes()) return Vec3(0);
    Vec3 light = lamps_.punctual(surface, scattering, random);
    if (!options_.sampleEmitters) return light;
    light += lamps_.emitters(surface, scattering, random);
    return light + lamps_.sky(surface, scattering, random);
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

}  // namespace vlf
