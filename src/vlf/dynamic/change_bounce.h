#pragma once
// Changed light bounces on: what objects take from the room or give it, all of the room gets to
// feel. Progressive radiosity on the change alone: a bounce by rays, and an ambient term for what
// follows (Cohen et al., "A progressive refinement approach to fast radiosity image generation",
// SIGGRAPH 1988).

#include "vlf/dynamic/bounce_rays.h"
#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/room_change.h"
#include "vlf/trace/ray_instances.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// A texel of the atlas and by how much its irradiance has changed, W·m⁻².
struct TexelChange {
    std::uint32_t texel;
    Vec3 irradiance;
};

/// Objects that light may meet on its way from texel to texel.
struct ObjectsBetween {
    const RayInstances& instances;    ///< the objects
    std::span<const Sphere> spheres;  ///< around them

    /// Whether any stands between two texels that see each other straight.
    bool block(std::uint32_t from, std::uint32_t to, const RoomTexels& room) const;
};

class ChangeBounce {
  public:
    /// Finds what the changes make the texels send to one another, what has bounced once by
    /// `rays`, the rest evenly all over the room. `roomFlux`: all that the room's texels send, W; a
    /// ray carries a fixed small part of it where there are enough. What meets an object is lost.
    void find(const RoomChange& change, const BounceRays& rays, const RoomTexels& room,
              const Coverage& coverage, const ObjectsBetween& objects, float roomFlux);

    /// Adds what was found, the rest only if it is more than `leastAmbient` (luminance, W·m⁻²).
    void addTo(RoomChange& change, float leastAmbient) const;

    /// Nothing is found.
    void clear();

  private:
    /// What a ray brings, and to what.
    struct Parcel {
        BounceRays::Unit unit;
        std::uint32_t number;  ///< of the texel, block or group
        int reach;             ///< texels about it that get it, too
        Vec3 flux;             ///< W
    };
    struct Sender;

    void deal(const Parcel& parcel, const RoomTexels& room);
    void spread(const Parcel& parcel, const RoomTexels& room);
    void collect(const RoomTexels& room);

    std::vector<std::vector<Parcel>> parcels_;  ///< by some groups that send them
    std::vector<TexelChange> near_;
    std::vector<Vec3> blocks_, groups_;  ///< flux, W; then irradiance of all of their texels, W·m⁻²
    Vec3 again_{0};                      ///< flux that is reflected once more, W
    Vec3 ambient_{0};                    ///< of all texels
    bool found_ = false;
};

}  // namespace vlf
