// Direct light without extent: of punctual lights and of directions of the sky.

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/propagate/light_gatherer.h"
#include "vlf/scene/light_beam.h"

#include <algorithm>
#include <cmath>

namespace vlf {

/// As seen from the receiver's middle, or from anywhere in it where that may be more.
float LightGatherer::likelyPunctual(const LightReceiver& r, const LightImage& image) const {
    PunctualLight light = sources_.lights[image.light].punctual;
    light.position = image.imageFromWorld.point(light.position);
    light.direction = image.imageFromWorld.vector(light.direction);
    const bool distant = light.kind == PunctualKind::directional;
    const float reach = distant ? 0 : r.radius;
    PunctualLight allRound = light;
    if (!distant) allRound.kind = PunctualKind::point;
    const LightBeam beam = beamOf(allRound, r.centre, std::max(0.5f * reach, rays_.epsilon()));
    const float slack = distant ? 0 : std::min(1.0f, reach / std::max(beam.distance, 1e-20f));
    const float cosine = glm::dot(r.normal, beam.toLight);
    if (r.planar && cosine < (slack < 1 ? -slack : -2)) return 0;
    float cone = 1;
    if (light.kind == PunctualKind::spot && slack < 1) {
        const float along = std::clamp(-glm::dot(light.direction, beam.toLight), -1.0f, 1.0f);
        cone = coneFactor(light, std::cos(std::max(std::acos(along) - std::asin(slack), 0.0f)));
    }
    if (cone <= 0 || (image.depth > 0 && !mayBeSeenInMirror(r, image))) return 0;
    const float facing = std::clamp(cosine + 0.5f * slack, 0.02f, 1.0f);
    return luminance(beam.irradiance * image.throughput) * cone * facing;
}

float LightGatherer::likelySky(const LightReceiver& r, const LightImage& image) const {
    if (image.depth > 0 && !mayBeSeenInMirror(r, image)) return 0;
    const float throughput = luminance(image.throughput);
    if (!r.planar) return throughput * sources_.sky->flux;
    // A reflection is its own inverse, transposed: the normal as the light's own space has it.
    return throughput *
           sources_.sky->irradiance(glm::transpose(image.imageFromWorld.linear) * r.normal);
}

DirectEstimate LightGatherer::gatherBeams(const LightReceiver& r, const LightImage& image, int n,
                                          RandomStream& random) {
    const bool punctual = sources_.lights[image.light].kind == LightKind::punctual;
    if (!punctual) {
        drawSkySamples(r, image, n, random);
        findVisible();
        return meanOfSamples(n);
    }
    // At each point it is what it is: all of them are all there is to know.
    const auto points = static_cast<int>(r.points.size());
    drawPunctualSamples(r, image, std::min(n, points), random);
    findVisible();
    DirectEstimate estimate = meanOfSamples(std::min(n, points));
    if (n >= points) estimate.variance = estimate.evenVariance = 0;
    return estimate;
}

/// What comes from a punctual light to points of the texel.
void LightGatherer::drawPunctualSamples(const LightReceiver& r, const LightImage& image, int n,
                                        RandomStream& random) {
    const PunctualLight& light = sources_.lights[image.light].punctual;
    PunctualLight seen = light;
    seen.position = image.imageFromWorld.point(light.position);
    seen.direction = image.imageFromWorld.vector(light.direction);
    const bool distant = light.kind == PunctualKind::directional;
    const float rotation = random.next();
    memory_.samples.clear();
    memory_.shadowRays.clear();
    for (int j = 0; j < n; ++j) {
        const Point p = pointOf(r, j, n, rotation);
        const LightBeam beam = beamOf(seen, p.position, rays_.epsilon());
        const float cosine = glm::dot(p.shading, beam.toLight);
        if (cosine <= 0 || glm::dot(p.geometric, beam.toLight) <= 0 ||
            !(maxComponent(beam.irradiance) > 0))
            continue;
        addSample(j, p, image, {distant ? -light.direction : light.position, distant},
                  cosine / receiverLobe(p.shading, p.geometric), beam.irradiance);
    }
}

/// Pairs of a point of the texel and a direction of the bright part of the sky.
void LightGatherer::drawSkySamples(const LightReceiver& r, const LightImage& image, int n,
                                   RandomStream& random) {
    const Sky& sky = sources_.sky->sky;
    const Vec2 shift = random.next2();
    const float rotation = random.next();
    memory_.samples.clear();
    memory_.shadowRays.clear();
    for (int j = 0; j < n; ++j) {
        const Point p = pointOf(r, j, n, rotation);
        const Sky::Sample s = sky.sample(r2Point(static_cast<std::uint32_t>(j), shift));
        const Vec3 direction = image.imageFromWorld.vector(s.direction);
        const float cosine = glm::dot(p.shading, direction);
        if (cosine <= 0 || glm::dot(p.geometric, direction) <= 0 || !(s.density > 0)) continue;
        addSample(j, p, image, {s.direction, true},
                  cosine / receiverLobe(p.shading, p.geometric) / s.density, s.bright);
    }
}

}  // namespace vlf
