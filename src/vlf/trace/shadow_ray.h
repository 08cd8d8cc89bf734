#pragma once
// Rays towards punctual lights.

#include "vlf/scene/light_beam.h"
#include "vlf/trace/ray_scene.h"

namespace vlf {

/// From `origin`, which has been moved off its surface by `epsilon`, along the beam. It ends a
/// little before the light, which may lie on a surface, too.
inline Ray shadowRay(const Vec3& origin, const LightBeam& beam, float epsilon) {
    return {origin, beam.toLight, 0, beam.distance - 2 * epsilon};
}

}  // namespace vlf
