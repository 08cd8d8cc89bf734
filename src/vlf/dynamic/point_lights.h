#pragma once
// A few point lights and an ambient term that stand for a baked room's emitters and the light they
// spread: what `lights` shades with and hard shadows are cast by.

#include "vlf/math/vector.h"

#include <vector>

namespace vlf {

/// A small emitting plane: towards a direction at angle θ from `normal` it sends intensity · cosθ⁺;
/// in every direction the same where `normal` is zero.
struct PointLight {
    Vec3 position{0};   ///< metres
    Vec3 intensity{0};  ///< W·sr⁻¹ along the normal
    Vec3 normal{0};
};

struct PointLighting {
    std::vector<PointLight> lights;  ///< the most powerful first
    Vec3 ambient{0};                 ///< irradiance, W·m⁻²
};

}  // namespace vlf
