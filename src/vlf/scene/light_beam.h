#pragma once
// The light of punctual lights at a point.

#include "vlf/scene/punctual_light.h"

#include <limits>
#include <span>

namespace vlf {

/// Light that comes to a point from one direction.
struct LightBeam {
    Vec3 toLight{0};                                          ///< unit
    float distance = std::numeric_limits<float>::infinity();  ///< to the light, metres
    Vec3 irradiance{0};  ///< of a surface that faces the light, nothing in the way, W·m⁻²
};

/// Part of a spot's intensity at an angle of this cosine from its axis: with
/// s = 1 / (cos inner - cos outer), the square of s (cosine - cos outer), clamped to [0, 1]
/// (KHR_lights_punctual).
float coneFactor(const PunctualLight& light, float cosine);

/// At `point`; nearer than `nearest` (> 0, metres) the light is taken to be that far, so that its
/// irradiance is finite everywhere, and 0 at the light itself.
LightBeam beamOf(const PunctualLight& light, const Vec3& point, float nearest);

/// One of several lights, by chance.
struct PickedBeam {
    LightBeam beam;
    float probability = 0;  ///< 0: none of them shines there
};

/// Picks in proportion to the luminance of their beams at `point`; u in [0, 1).
PickedBeam pickBeam(std::span<const PunctualLight> lights, const Vec3& point, float nearest,
                    float u);

/// All that a point or spot light sends, W: 4π I, or I times the integral of the cone's factor. Of
/// a directional light, which has no end, 0.
Vec3 powerOf(const PunctualLight& light);

}  // namespace vlf
