#pragma once
// Objects that emit: their direct light on the room and on other objects, straight and by way of
// one flat mirror of the room.

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
    std::uint32_t number = 0;        ///< of the object among the lit ones
    EmitterPoints points;            ///< their images in the room's flat mirrors among them
    std::vector<LightImage> images;  ///< by EmitterShare::image
};

/// `unwrap` is that of model.mesh(0).
std::unique_ptr<const ObjectEmitters> makeEmitters(const DynamicObject& object,
                                                   const Unwrap& unwrap, const Scene& scene,
                                                   const RoomTexels& room, std::uint32_t number);

/// What they send to points of surfaces. Keeps its memory: one for each thread.
class EmittedLight {
  public:
    EmittedLight(const RayScene& rays, const RoomTexels& room, const RayInstances& objects)
        : rays_(rays), room_(room), objects_(objects) {}

    /// Irradiance, W·m⁻², at a point with these unit normals.
    Vec3 irradiance(const ObjectEmitters& emitters, const Vec3& point, const Vec3& normal,
                    const Vec3& geometric);

  private:
    /// Light that arrives unless something is in the way of one of its two legs.
    struct Way {
        Vec3 light{0};
        Ray fromMirror;  ///< to the emitter; used with a mirror
        std::uint32_t mirror = kNoChart;
    };

    void find(const ObjectEmitters& emitters, const EmitterShare& share, const Vec3& origin,
              const Vec3& normal, const Vec3& geometric);
    void keepThoseByMirrors();
    void blockRays();

    const RayScene& rays_;
    const RoomTexels& room_;
    const RayInstances& objects_;
    std::vector<float> solidAngles_;
    std::vector<Way> ways_;
    std::vector<Ray> queue_;  ///< of the ways, from the receiver
    std::vector<std::uint8_t> blocked_, blockedByObject_;
};

/// Irradiance that they give the room's texels, W·m⁻². Where nine texels of a square of 64 agree
/// that it changes evenly, those between are interpolated.
void findEmittedLight(const ObjectEmitters& emitters, const Scene& scene, const RayScene& rays,
                      const RoomTexels& room, const Coverage& coverage, const RayInstances& objects,
                      std::vector<TexelChange>& light);

}  // namespace vlf
