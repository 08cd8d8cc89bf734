#include "vlf/propagate/entering_light.h"

#include "vlf/base/parallel.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/light_beam.h"

#include <vector>

namespace vlf {

namespace {

constexpr std::size_t kBlocks = 256, kRaysPerBlock = 512;

/// Mean over lines of what `radiance` says of their direction (by its density), times the area of
/// the disc that they are spread over; 0 for those that miss the scene.
template <class Draw>
glm::dvec3 fluxOf(const Sphere& sphere, const RayScene& rays, Draw draw) {
    std::vector<glm::dvec3> sums(kBlocks, glm::dvec3(0));
    parallelFor(kBlocks, [&](std::size_t block) {
        RandomStream random(0x5c1, block);
        for (std::size_t k = 0; k < kRaysPerBlock; ++k) {
            const auto i = static_cast<std::uint32_t>(block * kRaysPerBlock + k);
            const auto [towards, power] = draw(r2Point(i, Vec2(0.5f)));
            const Vec2 u = random.next2();
            const float r = sphere.radius * std::sqrt(u.x), phi = 2 * kPi * u.y;
            const Vec3 offset =
                frameFromNormal(towards).toWorld({r * std::cos(phi), r * std::sin(phi), 0});
            const Vec3 origin = sphere.centre + offset + 1.1f * sphere.radius * towards;
            if (rays.occluded({origin, -towards})) sums[block] += glm::dvec3(power);
        }
    });
    glm::dvec3 sum(0);
    for (const glm::dvec3& s : sums) sum += s;
    const double disc = std::numbers::pi * static_cast<double>(sphere.radius) * sphere.radius;
    return sum * disc / static_cast<double>(kBlocks * kRaysPerBlock);
}

struct Drawn {
    Vec3 towards;  ///< where it comes from
    Vec3 power;    ///< radiance by density
};

}  // namespace

Vec3 enteringFlux(const Scene& scene, const RayScene& rays, const SkyLight* sky) {
    const Sphere sphere = boundingSphere(scene);
    glm::dvec3 flux(0);
    if (sky && !sky->sky.isBlack())
        flux += fluxOf(sphere, rays, [&](const Vec2& u) {
            const Vec3 d = sampleUniformSphere(u);
            return Drawn{d, 4 * kPi * sky->sky.smooth(d)};
        });
    if (sky && sky->sky.hasBright())
        flux += fluxOf(sphere, rays, [&](const Vec2& u) {
            const Sky::Sample s = sky->sky.sample(u);
            return Drawn{s.direction, s.density > 0 ? s.bright / s.density : Vec3(0)};
        });
    for (const PunctualLight& light : scene.lights)
        if (light.kind == PunctualKind::directional)
            flux += fluxOf(sphere, rays,
                           [&](const Vec2&) { return Drawn{-light.direction, light.intensity}; });
    return Vec3(flux);
}

Vec3 emittedFlux(const Scene& scene, const RayScene& rays, const SkyLight* sky) {
    Vec3 flux = enteringFlux(scene, rays, sky);
    for (const PunctualLight& light : scene.lights) flux += powerOf(light);
    return flux;
}

}  // namespace vlf
