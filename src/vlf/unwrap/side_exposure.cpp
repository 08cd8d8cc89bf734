#include "vlf/unwrap/side_exposure.h"

#include "vlf/base/parallel.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

namespace vlf {

namespace {

constexpr int kBounces = 16;
constexpr std::size_t kFloodPerGroup = 24, kLeastFlood = 8000, kGreatestFlood = 2000000;
constexpr std::uint32_t kMinParticles = 4;
constexpr float kMinShare = 0.01f;  // of those that reach either side: less is a crack

/// Chance of going through glass, either side of which is open, rather than back.
constexpr float kPassesGlass = 0.75f;

/// Particles that have reached each side of a group.
struct Counter {
    std::atomic<std::uint32_t> front{0}, back{0};
};

/// Sides that a particle has reached. It counts once at each: between a panel and the wall close
/// behind it, one that slips in is thrown to and fro.
class Reached {
  public:
    /// Whether it is the first time.
    bool add(std::uint32_t group, bool front) {
        const std::uint64_t side = 2 * std::uint64_t{group} + front;
        const auto end = sides_.begin() + count_;
        if (std::find(sides_.begin(), end, side) != end) return false;
        sides_[count_++] = side;
        return true;
    }

  private:
    std::array<std::uint64_t, kBounces> sides_;
    int count_ = 0;
};

/// Where particles start: emitters by area, all triangles if there are none.
struct Sources {
    std::vector<std::uint32_t> triangles;
    std::vector<double> cumulativeArea;

    explicit Sources(const Scene& scene) {
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
            if (scene.material(t).isEmitter()) triangles.push_back(t);
        if (triangles.empty()) {
            triangles.resize(scene.triangles.size());
            std::iota(triangles.begin(), triangles.end(), 0u);
        }
        double sum = 0;
        for (const std::uint32_t t : triangles) cumulativeArea.push_back(sum += area(scene, t));
    }

    std::uint32_t pick(float u) const {
        const auto it = std::upper_bound(cumulativeArea.begin(), cumulativeArea.end(),
                                         u * cumulativeArea.back());
        const auto i = std::min<std::size_t>(it - cumulativeArea.begin(), triangles.size() - 1);
        return triangles[i];
    }
};

Vec3 behind(const Scene& scene, const Hit& hit, const Vec3& direction, float epsilon) {
    const Vec3 normal = geometricNormal(scene, hit.triangle);
    return positionAt(scene, hit.triangle, hit.barycentric) +
           (glm::dot(normal, direction) > 0 ? epsilon : -epsilon) * normal;
}

Vec3 bounced(const Vec3& normal, RandomStream& random) {
    return frameFromNormal(normal).toWorld(sampleCosineHemisphere(random.next2()));
}

void followParticle(const Scene& scene, const RayScene& rays,
                    const std::vector<std::uint32_t>& groupOf, std::vector<Counter>& counters,
                    Ray ray, RandomStream& random) {
    Reached reached;
    for (int bounce = 0; bounce < kBounces; ++bounce) {
        Hit hit = rays.closest(ray);
        while (hit && scene.material(hit.triangle).isGlass() && random.next() < kPassesGlass)
            hit = rays.closest({behind(scene, hit, ray.direction, rays.epsilon()), ray.direction});
        if (!hit) return;
        Vec3 normal = geometricNormal(scene, hit.triangle);
        const bool front = glm::dot(normal, ray.direction) < 0;
        const std::uint32_t group = groupOf[hit.triangle];
        Counter& counter = counters[group];
        if (reached.add(group, front))
            (front ? counter.front : counter.back).fetch_add(1, std::memory_order_relaxed);
        if (!front) normal = -normal;
        const Vec3 position = positionAt(scene, hit.triangle, hit.barycentric);
        ray = {position + rays.epsilon() * normal, bounced(normal, random)};
    }
}

Ray fromSource(const Scene& scene, const RayScene& rays, const Sources& sources,
               RandomStream& random) {
    const std::uint32_t triangle = sources.pick(random.next());
    const Vec3 position = positionAt(scene, triangle, sampleUniformTriangle(random.next2()));
    const Vec3 normal = geometricNormal(scene, triangle);
    return {position + rays.epsilon() * normal, bounced(normal, random)};
}

/// From a direction, through the sphere around the scene.
Ray fromOutside(const Sphere& sphere, const Vec3& direction, RandomStream& random) {
    const Vec2 u = random.next2();
    const float r = sphere.radius * std::sqrt(u.x), phi = 2 * kPi * u.y;
    const Vec3 offset =
        frameFromNormal(direction).toWorld({r * std::cos(phi), r * std::sin(phi), 0});
    return {sphere.centre + offset - 1.1f * sphere.radius * direction, direction};
}

/// From one of the punctual lights.
Ray fromLight(const Scene& scene, const Sphere& sphere, RandomStream& random) {
    const PunctualLight& light = scene.lights[random.nextBits() % scene.lights.size()];
    if (light.kind == PunctualKind::directional)
        return fromOutside(sphere, light.direction, random);
    const Vec2 u = random.next2();
    if (light.kind == PunctualKind::point) return {light.position, sampleUniformSphere(u)};
    const float z = 1 - u.x * (1 - std::cos(light.outerCone)), phi = 2 * kPi * u.y;
    const float s = std::sqrt(std::max(0.0f, 1 - z * z));
    const Vec3 local(s * std::cos(phi), s * std::sin(phi), z);
    return {light.position, frameFromNormal(light.direction).toWorld(local)};
}

OpenSides classify(std::uint32_t front, std::uint32_t back) {
    const bool backOpen = back >= kMinParticles && back > kMinShare * (front + back);
    const bool frontReached = front >= kMinParticles && front > kMinShare * (front + back);
    return {frontReached || !backOpen, backOpen};
}

}  // namespace

std::vector<OpenSides> findOpenSides(const Scene& scene, const RayScene& rays,
                                     const std::vector<ChartGroup>& groups,
                                     const std::vector<std::uint32_t>& groupOf,
                                     std::uint64_t seed) {
    std::vector<Counter> counters(groups.size());
    const std::size_t particles =
        std::clamp(kFloodPerGroup * groups.size(), kLeastFlood, kGreatestFlood);
    const Sphere sphere = boundingSphere(scene);
    const bool sky = !scene.environment.isBlack(), lights = !scene.lights.empty();
    const auto flood = [&](std::size_t number, const auto& start) {
        parallelFor(particles, 256, [&](std::size_t i) {
            RandomStream random(seed, number * particles + i);
            const Ray ray = start(random);
            followParticle(scene, rays, groupOf, counters, ray, random);
        });
    };
    if (hasEmitter(scene) || !(sky || lights)) {
        const Sources sources(scene);
        flood(0, [&](RandomStream& r) { return fromSource(scene, rays, sources, r); });
    }
    if (sky)
        flood(1, [&](RandomStream& r) {
            return fromOutside(sphere, sampleUniformSphere(r.next2()), r);
        });
    if (lights) flood(2, [&](RandomStream& r) { return fromLight(scene, sphere, r); });
    std::vector<OpenSides> sides(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        sides[g] = classify(counters[g].front, counters[g].back);
        // An emitting side is seen, whether or not other light reaches it.
        const Material& material = scene.material(groups[g].triangles.front());
        sides[g].front = sides[g].front || material.isEmitter() || material.isGlass();
        sides[g].back = sides[g].back || material.emitsBothSides || material.isGlass();
    }
    return sides;
}

}  // namespace vlf
