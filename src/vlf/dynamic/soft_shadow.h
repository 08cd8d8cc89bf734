#pragma once
// Direct light of the room's emitters that objects take from its texels: shadow rays of the texels
// that may lie in a shadow, as in the bake.

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/room_texels.h"
#include "vlf/propagate/light_gatherer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// Irradiance that entries of room.unwrap.texels lose, W·m⁻² >= 0.
struct TexelLoss {
    std::vector<std::uint32_t> entries;
    std::vector<Vec3> loss;
};

/// Entries of room.unwrap.texels from which one of the spheres may hide a part of an emitter or of
/// its image in a mirror.
std::vector<std::uint32_t> texelsInShadow(const Scene& scene, const RoomTexels& room,
                                          std::span<const Sphere> objects);

/// `occluder`: the objects. What they cover loses nothing.
TexelLoss findSoftShadows(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                          const Coverage& coverage, std::span<const Sphere> objects,
                          const ExtraOccluder& occluder, int samples);

}  // namespace vlf
