#include "vlf/scene/light_beam.h"

#include <algorithm>
#include <cmath>

namespace vlf {

float coneFactor(const PunctualLight& light, float cosine) {
    const float outer = std::cos(light.outerCone);
    const float width = std::max(std::cos(light.innerCone) - outer, 1e-6f);
    const float linear = std::clamp((cosine - outer) / width, 0.0f, 1.0f);
    return linear * linear;
}

LightBeam beamOf(const PunctualLight& light, const Vec3& point, float nearest) {
    LightBeam beam;
    if (light.kind == PunctualKind::directional) {
        beam.toLight = -light.direction;
        beam.irradiance = light.intensity;
        return beam;
    }
    const Vec3 way = light.position - point;
    const float length = glm::length(way);
    beam.distance = length;
    beam.toLight = length > 0 ? way / length : -light.direction;
    if (!(length > 0)) return beam;
    const float distance = std::max(length, nearest);
    beam.irradiance = light.intensity / (distance * distance);
    if (light.kind == PunctualKind::spot)
        beam.irradiance *= coneFactor(light, -glm::dot(light.direction, beam.toLight));
    return beam;
}

PickedBeam pickBeam(std::span<const PunctualLight> lights, const Vec3& point, float nearest,
                    float u) {
    float sum = 0;
    for (const PunctualLight& light : lights)
        sum += luminance(beamOf(light, point, nearest).irradiance);
    if (!(sum > 0)) return {};
    float passed = 0;
    PickedBeam picked;
    for (const PunctualLight& light : lights) {
        const LightBeam beam = beamOf(light, point, nearest);
        const float share = luminance(beam.irradiance);
        if (!(share > 0)) continue;
        picked = {beam, share / sum};
        if ((passed += share) > u * sum) break;
    }
    return picked;
}

Vec3 powerOf(const PunctualLight& light) {
    switch (light.kind) {
        case PunctualKind::point:
            return 4 * kPi * light.intensity;
        case PunctualKind::spot: {
            // 2π ∫ factor dz: all of it within the inner cone, a third between the cones.
            const float inner = std::cos(light.innerCone), outer = std::cos(light.outerCone);
            return 2 * kPi * ((1 - inner) + (inner - outer) / 3) * light.intensity;
        }
        default:
            return Vec3(0);
    }
}

}  // namespace vlf
