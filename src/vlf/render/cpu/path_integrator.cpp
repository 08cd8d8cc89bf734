#include "vlf/render/cpu/path_integrator.h"

#include "vlf/math/frame.h"
#include "vlf/math/sampling.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr float kCertain = std::numeric_limits<float>::infinity();

/// Paths of this many segments and more are continued by chance.
constexpr int kRouletteDepth = 4;

/// Keeps paths between perfect mirrors finite.
constexpr float kMaxSurvival = 0.97f;

/// At most half of the cosine lobe lies below the surface: a longer row of rejections never occurs.
constexpr int kMaxRejections = 128;

/// Weight of a sample drawn with density p where another technique has density q (power
/// heuristic, exponent 2). p may be infinite: a direction that only this technique can draw.
float powerHeuristic(float p, float q) {
    const float ratio = q / p;
    return 1 / (1 + ratio * ratio);
}

/// Chance with which a path is continued by the diffuse lobe rather than the mirror.
float diffuseChance(const Surface& surface) {
    const float diffuse = maxComponent(surface.diffuse), mirror = maxComponent(surface.mirror);
    return diffuse > 0 ? diffuse / (diffuse + mirror) : 0;
}

Vec3 sampleCosineLobe(const Surface& surface, RandomStream& random) {
    const Frame frame = frameFromNormal(surface.normal);
    for (int i = 0; i < kMaxRejections; ++i) {
        const Vec3 direction = frame.toWorld(sampleCosineHemisphere(random.next2()));
        if (cosineLobe(surface, direction) > 0) return glm::normalize(direction);
    }
    return surface.geometricNormal;
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
    float density = kCertain;  ///< with which the diffuse lobe drew ray.direction, per steradian
    int depth = 1;             ///< segments, that of `ray` included
    Hit hit{};                 ///< of `ray`
};

PathIntegrator::PathIntegrator(const Scene& scene, const RayScene& rays, const PathOptions& options)
    : scene_(scene), rays_(rays), options_(options), emitters_(scene) {
    if (emitters_.empty()) options_.sampleEmitters = false;
}

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
    Path path;
    scatter(white, 1, path, random);
    path.depth = 1;
    path.hit = rays_.closest(path.ray);
    if (path.hit) {
        const SidePoint seen = pointFacing(scene_, path.hit, path.ray.direction);
        if (!isOpen(seen.triangle, seen.front)) return std::nullopt;
    }
    const Vec3 direct = directLight(white, 1, random);
    return kPi * (direct + followPath(path, random));
}

Vec3 PathIntegrator::followPath(Path path, RandomStream& random) const {
    Vec3 radiance(0);
    while (path.hit) {
        const SidePoint point = pointFacing(scene_, path.hit, path.ray.direction);
        radiance += path.throughput * emitterSeen(path, point);
        if (path.depth == options_.maxDepth) break;
        const Surface surface = surfaceAt(scene_, point);
        if (maxComponent(surface.diffuse + surface.mirror) <= 0) break;
        const float chance = diffuseChance(surface);
        radiance += path.throughput * directLight(surface, chance, random);
        scatter(surface, chance, path, random);
        if (path.depth >= kRouletteDepth && !survivesRoulette(path.throughput, random)) break;
        path.hit = rays_.closest(path.ray);
    }
    return radiance;
}

Vec3 PathIntegrator::emitterSeen(const Path& path, const SidePoint& point) const {
    const Vec3 emission = emittedRadiance(scene_, point);
    if (!options_.sampleEmitters || path.density == kCertain || emission == Vec3(0))
        return emission;
    const float cosine =
        std::abs(glm::dot(geometricNormal(scene_, point.triangle), path.ray.direction));
    const float density = emitters_.density(point.triangle) * path.hit.t * path.hit.t / cosine;
    return emission * powerHeuristic(path.density, density);
}

Vec3 PathIntegrator::directLight(const Surface& surface, float chance, RandomStream& random) const {
    if (!options_.sampleEmitters || chance <= 0) return Vec3(0);
    SidePoint point = emitters_.sample(random);
    Surface emitter = surfaceAt(scene_, point);
    const Vec3 between = emitter.position - surface.position;
    const float distance2 = glm::dot(between, between);
    const Vec3 direction = between / std::sqrt(distance2);
    const float lobe = cosineLobe(surface, direction);
    if (!(distance2 > 0) || lobe <= 0) return Vec3(0);
    if (glm::dot(emitter.geometricNormal, direction) > 0) {
        point.front = false;
        emitter.geometricNormal = -emitter.geometricNormal;
    }
    const Vec3 emission = emittedRadiance(scene_, point);
    if (emission == Vec3(0) || !visible(surface, emitter)) return Vec3(0);
    const float density = emitters_.density(point.triangle) * distance2 /
                          -glm::dot(emitter.geometricNormal, direction);
    return surface.diffuse * emission * (lobe / density * powerHeuristic(density, chance * lobe));
}

void PathIntegrator::scatter(const Surface& surface, float chance, Path& path,
                             RandomStream& random) const {
    ++path.depth;
    if (chance >= 1 || random.next() < chance) {
        const Vec3 direction = sampleCosineLobe(surface, random);
        path.throughput *= surface.diffuse / chance;
        path.density = chance * cosineLobe(surface, direction);
        path.ray = rayFrom(surface, direction);
    } else {
        path.throughput *= surface.mirror / (1 - chance);
        path.density = kCertain;
        path.ray = rayFrom(surface, mirrorDirection(surface, path.ray.direction));
    }
}

Ray PathIntegrator::rayFrom(const Surface& surface, const Vec3& direction) const {
    return {surface.position + rays_.epsilon() * surface.geometricNormal, direction};
}

bool PathIntegrator::visible(const Surface& surface, const Surface& emitter) const {
    const Vec3 from = surface.position + rays_.epsilon() * surface.geometricNormal;
    const Vec3 to = emitter.position + rays_.epsilon() * emitter.geometricNormal;
    return !rays_.occluded({from, to - from, 0, 1});
}

}  // namespace vlf
