#pragma once
// A baked room with its light, as what happens in it reads it.

#include "vlf/dynamic/room_texels.h"
#include "vlf/trace/ray_scene.h"

#include <span>

namespace vlf {

/// The room as it is without objects, and what is known of it. By atlas texel: the diffuse radiance
/// that leaves it, W·m⁻²·sr⁻¹.
struct LitRoom {
    const Scene& scene;
    const RayScene& rays;
    const RoomTexels& texels;
    std::span<const Vec3> radiance;
};

}  // namespace vlf
