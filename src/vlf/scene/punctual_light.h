#pragma once
// Lights without extent, as glTF's KHR_lights_punctual has them.

#include "vlf/math/vector.h"

#include <cstdint>
#include <string>

namespace vlf {

enum class PunctualKind : std::uint8_t { point, spot, directional };

/// A light that no ray can meet. A spot's intensity is full within the inner cone and falls to 0 at
/// the outer one, see coneFactor (light_beam.h).
struct PunctualLight {
    std::string name;
    PunctualKind kind = PunctualKind::point;
    Vec3 position{0};          ///< metres; not of a directional one, which is infinitely far
    Vec3 direction{0, 0, -1};  ///< unit, in which it shines; not of a point
    Vec3 intensity{1};         ///< W·sr⁻¹; of a directional one irradiance across it, W·m⁻²
    float innerCone = 0;       ///< of a spot: half angles, radians, 0 <= inner < outer <= π / 2
    float outerCone = 0.7853982f;
};

}  // namespace vlf
