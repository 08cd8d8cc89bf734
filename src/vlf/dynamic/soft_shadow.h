#pragma once
// Direct light of the room's emitters that objects take from its texels, those that may lie in a
// shadow.
//
// Of an emitter that looks small beside an object points are sampled, as in the bake, and held
// against the objects. Of one that looks larger an object hides a small part, which few of its
// points would find: there the directions to the object are sampled, and what of the emitter they
// show behind it.

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/room_texels.h"
#include "vlf/propagate/light_gatherer.h"
#include "vlf/trace/ray_instances.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vlf {

/// The objects in the way of light.
ExtraOccluder occluderOf(const RayInstances& objects);

/// Irradiance that entries of room.unwrap.texels lose, W·m⁻² >= 0.
struct TexelLoss {
    std::vector<std::uint32_t> entries;
    std::vector<Vec3> loss;
};

/// Entries of room.unwrap.texels from which one of the spheres may hide a part of an emitter or of
/// its image in a mirror.
std::vector<std::uint32_t> texelsInShadow(const Scene& scene, const RoomTexels& room,
                                          std::span<const Sphere> objects);

/// A light or an image of it, and the objects as they stand in its way: those before mirrors, and
/// the images of those behind.
struct Obstruction {
    Sphere light;
    std::vector<Sphere> objects;
};

class SoftShadows {
  public:
    /// `casters` are the objects, in the order of the spheres around them. What they cover loses
    /// nothing. `samples` of each texel, at most. Over squares of 64 texels where nine agree that
    /// it changes evenly, or to less than `slight` (W·m⁻²), it is interpolated. Valid until the
    /// next call.
    const TexelLoss& find(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                          const Coverage& coverage, const RayInstances& casters,
                          std::span<const Sphere> objects, int samples, float slight);

  private:
    std::vector<Obstruction> obstructions_;
    std::vector<std::uint32_t> groups_;  ///< of texels, that may be shadowed
    std::vector<std::vector<std::pair<std::uint32_t, Vec3>>> parts_;  ///< entries and loss by group
    TexelLoss loss_;
};

}  // namespace vlf
