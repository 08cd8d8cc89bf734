#include "vlf/render/cpu/lamp_light.h"

#include "vlf/trace/shadow_ray.h"

namespace vlf {

namespace {

/// As many punctual lights are all asked at every point; of more, one is picked.
constexpr std::size_t kFewLights = 4;

/// Weight of a sample drawn with density p where another technique has density q (power
/// heuristic, exponent 2). p may be infinite: a direction that only this technique can draw.
float powerHeuristic(float p, float q) {
    const float ratio = q / p;
    return 1 / (1 + ratio * ratio);
}

}  // namespace

LampLight::LampLight(const Scene& scene, const RayScene& rays, const RayInstances* objects)
    : scene_(scene),
      rays_(rays),
      objects_(objects),
      emitters_(scene),
      sky_(scene.environment, meanLuminance(scene.environment)) {}

float LampLight::weightOfSky(const Vec3& direction, float density) const {
    if (density == kCertain || !sky_.hasBright()) return 1;
    return powerHeuristic(density, sky_.density(direction));
}

float LampLight::weightOfEmitter(const SidePoint& point, const Vec3& direction, float distance,
                                 float density) const {
    if (density == kCertain) return 1;
    const float cosine = std::abs(glm::dot(geometricNormal(scene_, point.triangle), direction));
    return powerHeuristic(density,
                          emitters_.density(point.triangle) * distance * distance / cosine);
}

Vec3 LampLight::punctual(const Surface& surface, const Scattering& scattering,
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

Vec3 LampLight::beamLight(const Surface& surface, const Scattering& scattering,
                          const LightBeam& beam) const {
    const Vec3 light = scattering.lobes(beam.toLight) * beam.irradiance;
    if (!(maxComponent(light) > 0)) return Vec3(0);
    const Vec3 origin = rayFrom(surface, beam.toLight).origin;
    return light * passed(shadowRay(origin, beam, rays_.epsilon())).colour;
}

Vec3 LampLight::sky(const Surface& surface, const Scattering& scattering,
                    RandomStream& random) const {
    if (!sky_.hasBright()) return Vec3(0);
    const Sky::Sample sample = sky_.sample(random.next2());
    const Vec3 lobes = scattering.lobes(sample.direction);
    if (maxComponent(lobes) <= 0 || !(sample.density > 0)) return Vec3(0);
    const Transmittance seen = passed(rayFrom(surface, sample.direction));
    const float byChance = scattering.density(sample.direction) * seen.chance;
    const float weight = powerHeuristic(sample.density, byChance);
    return lobes * sky_.radiance(sample.direction) * seen.colour * (weight / sample.density);
}

Vec3 LampLight::emitters(const Surface& surface, const Scattering& scattering,
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
    const Vec3 from = rayFrom(surface, direction).origin;
    const Vec3 to = emitter.position + rays_.epsilon() * emitter.geometricNormal;
    const Transmittance seen = passed({from, to - from, 0, 1});
    if (seen.colour == Vec3(0)) return Vec3(0);
    const float density = emitters_.density(point.triangle) * distance2 /
                          -glm::dot(emitter.geometricNormal, direction);
    const float byChance = scattering.density(direction) * seen.chance;
    return lobes * emission * seen.colour * (powerHeuristic(density, byChance) / density);
}

Transmittance LampLight::passed(const Ray& ray) const {
    if (objects_ && objects_->occluded(ray)) return {Vec3(0), 0};
    return rays_.transmittance(ray);
}

Ray LampLight::rayFrom(const Surface& surface, const Vec3& direction) const {
    return {surface.position + rays_.epsilon() * surface.geometricNormal, direction};
}

}  // namespace vlf
