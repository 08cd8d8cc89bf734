#pragma once
// How much light comes into a scene from outside.

#include "vlf/propagate/sky_light.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

namespace vlf {

/// Flux (W) of the environment, if any, and of directional lights on the scene: of all lines that
/// meet any of it. About 0.2 % off by chance, the same for the same scene.
Vec3 enteringFlux(const Scene& scene, const RayScene& rays, const SkyLight* sky);

/// That, and what punctual lights within it send.
Vec3 emittedFlux(const Scene& scene, const RayScene& rays, const SkyLight* sky);

}  // namespace vlf
