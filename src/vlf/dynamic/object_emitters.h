#pragma once
// Objects that emit: their direct light on the room and on other objects.

#include "vlf/dynamic/change_bounce.h"
#include "vlf/dynamic/object.h"
#include "vlf/dynamic/object_receivers.h"
#include "vlf/propagate/light_sources.h"

#include <memory>
#include <vector>

namespace vlf {

/// The emitting surfaces of an object where it is, as light sources.
struct ObjectEmitters {
    std::uint32_t number = 0;  ///< of the object among the lit ones
    Scene posed;
    LightSources sources;
};

/// `unwrap` is that of model.mesh(0).
std::unique_ptr<const ObjectEmitters> makeEmitters(const DynamicObject& object,
                                                   const Unwrap& unwrap, std::uint32_t number);

/// Irradiance that they give the room's texels, W·m⁻². Where nine texels of a square of 64 agree
/// that it changes evenly, those between are interpolated.
void findEmittedLight(const ObjectEmitters& emitters, const Scene& scene, const RayScene& rays,
                      const RoomTexels& room, const Coverage& coverage,
                      const ExtraOccluder& occluder, int samples, std::vector<TexelChange>& light);

}  // namespace vlf
