#pragma once
// Changed light bounces on: what objects take from the room or give it, all of the room gets to
// feel. Progressive radiosity on the change alone: a bounce by rays, and an ambient term for what
// follows (Cohen et al., "A progressive refinement approach to fast radiosity image generation",
// SIGGRAPH 1988).

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/room_change.h"
#include "vlf/dynamic/sight.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// A texel of the atlas and by how much its irradiance has changed, W·m⁻².
struct TexelChange {
    std::uint32_t texel;
    Vec3 irradiance;
};

class ChangeBounce {
  public:
    /// Finds what the changes make the texels send to one another: the first bounce by rays, each
    /// from a texel picked in proportion to its flux, the rest evenly all over the room.
    /// `roomFlux`: all that the room's texels send, W; a ray carries a fixed small part of it, so
    /// that what it does to the texels that it comes to is as slight whatever the change.
    void find(const RoomChange& change, const Scene& scene, const RayScene& roomRays,
              const RoomTexels& room, const Coverage& coverage, const SightObjects& objects,
              float roomFlux);

    /// Adds what was found, the rest only if it is more than `leastAmbient` (luminance, W·m⁻²).
    void addTo(RoomChange& change, float leastAmbient) const;

    /// Nothing is found.
    void clear();

  private:
    struct Arrival {
        std::uint32_t texel;
        float distance;  ///< metres from where it was sent
        Vec3 flux;       ///< W
    };

    void aim(const RoomChange& change, const Scene& scene, float epsilon, const RoomTexels& room,
             const Coverage& coverage, float roomFlux);
    void shoot(const Scene& scene, const RayScene& roomRays, const RoomTexels& room,
               const SightObjects& objects);
    void spread(const Arrival& arrival, const RoomTexels& room, const Coverage& coverage);
    void collect(const RoomTexels& room, const Coverage& coverage);

    std::vector<Vec3> flux_;  ///< of the changed texels
    std::vector<Ray> rays_;
    std::vector<Vec3> carried_;  ///< flux of each ray, W
    std::vector<std::vector<Arrival>> arrivals_;
    std::vector<TexelChange> near_;
    std::vector<std::uint32_t> square_;
    std::vector<Vec3> groups_;  ///< change of irradiance of all of a group's texels, W·m⁻²
    std::vector<std::uint8_t> groupListed_;  ///< in changedGroups_
    std::vector<std::uint32_t> changedGroups_;
    Vec3 ambient_{0};  ///< of all texels
};

}  // namespace vlf
