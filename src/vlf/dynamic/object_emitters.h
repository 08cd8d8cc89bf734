#pragma once
// Objects that emit: their direct light on the room and on other objects.

#include "vlf/dynamic/change_bounce.h"
#include "vlf/dynamic/emitter_points.h"
#include "vlf/dynamic/object.h"
#include "vlf/dynamic/object_receivers.h"
#include "vlf/trace/ray_instances.h"

#include <memory>
#include <vector>

namespace vlf {

/// The emitting surfaces of an object where it is: the same few points for whoever is lit by them,
/// so that nothing flickers.
struct ObjectEmitters {
    std::uint32_t number = 0;  ///< of the object among the lit ones
    EmitterPoints points;
};

/// `unwrap` is that of model.mesh(0).
std::unique_ptr<const ObjectEmitters> makeEmitters(const DynamicObject& object,
                                                   const Unwrap& unwrap, std::uint32_t number);

/// What they send to points of surfaces. Keeps its memory: one for each thread.
class EmittedLight {
  public:
    EmittedLight(const RayScene& room, const RayInstances& objects)
        : room_(room), objects_(objects) {}

    /// Irradiance, W·m⁻², at a point with these unit normals.
    Vec3 irradiance(const EmitterPoints& emitters, const Vec3& point, const Vec3& normal,
                    const Vec3& geometric);

  private:
    const RayScene& room_;
    const RayInstances& objects_;
    std::vector<float> solidAngles_;
    std::vector<Ray> rays_;
    std::vector<Vec3> light_;
    std::vector<std::uint8_t> blocked_, blockedByObject_;
};

/// Irradiance that they give the room's texels, W·m⁻². Where nine texels of a square of 64 agree
/// that it changes evenly, those between are interpolated.
void findEmittedLight(const ObjectEmitters& emitters, const Scene& scene, const RayScene& rays,
                      const RoomTexels& room, const Coverage& coverage, const RayInstances& objects,
                      std::vector<TexelChange>& light);

}  // namespace vlf
