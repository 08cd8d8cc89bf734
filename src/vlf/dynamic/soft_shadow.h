#pragma once
// Direct light of the room's emitters that objects take from its texels, those that may lie in a
// shadow.
//
// Of an emitter that looks small beside an object points are sampled, as in the bake, and held
// against the objects. Of one that looks larger an object hides a small part, which few of its
// points would find: there points of the object are taken, and what of the emitter is behind them
// (shadowed_texel.h).

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/obstruction.h"
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
    std::vector<std::uint32_t>
        groups;  ///< of RoomTexels: all their texels lose alike, by weak shadows
    std::vector<Vec3> groupLoss;
};

/// Entries of room.unwrap.texels from which one of the objects may hide a part of an emitter or of
/// its image in a mirror.
std::vector<std::uint32_t> texelsInShadow(const Scene& scene, const RayScene& rays,
                                          const RoomTexels& room,
                                          std::span<const ShadowCaster> objects);

class SoftShadows {
  public:
    /// What it refers to must outlive it.
    SoftShadows(const Scene& scene, const RayScene& rays, const RoomTexels& room)
        : scene_(scene), rays_(rays), room_(room), obstructions_(scene, rays, room) {}

    /// `rays` are those of the objects, in their order. What they cover loses nothing. `samples` of
    /// each texel, at most. Over squares of 64 texels where nine agree that it changes evenly, or
    /// to less than `slight` (W·m⁻²), and over quarters of them where five do, it is interpolated;
    /// light that is much less is let be. Valid until the next call.
    const TexelLoss& find(const Coverage& coverage, const RayInstances& rays,
                          std::span<const ShadowCaster> objects, int samples, float slight);

  private:
    const Scene& scene_;
    const RayScene& rays_;
    const RoomTexels& room_;
    Obstructions obstructions_;
    std::vector<std::vector<std::pair<std::uint32_t, Vec3>>> parts_;  ///< entries and loss by group
    std::vector<Vec3> weak_;                                          ///< of all of a group
    TexelLoss loss_;
};

}  // namespace vlf
