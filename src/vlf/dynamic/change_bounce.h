#pragma once
// Changed light bounces on: what objects take from a texel or give it, the others get to feel
// (progressive radiosity on the change alone; Cohen et al., "A progressive refinement approach to
// fast radiosity image generation", SIGGRAPH 1988).

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

struct BounceParams {
    int rays = 2048;  ///< a bounce, dealt out by flux
    int bounces = 1;
};

/// Sends the light that changed texels reflect to the others, and so on. Keeps its memory.
class ChangeBounce {
  public:
    /// Adds to `change` what `sources` make the texels send one another; `change` may have them
    /// already.
    void add(std::span<const TexelChange> sources, const Scene& scene, const RayScene& rays,
             const RoomTexels& room, const Coverage& coverage, const SightObjects& objects,
             const BounceParams& params, RoomChange& change);

  private:
    /// Flux that a texel sends, W, in its share of rays.
    struct Shot {
        std::uint32_t texel;
        Vec3 flux;
        int rays;
    };
    struct Arrival {
        std::uint32_t texel;
        Vec3 flux;
    };

    void deal(std::span<const TexelChange> sources, const RoomTexels& room,
              const Coverage& coverage, int rays);
    void aim(const Shot& shot, const Scene& scene, float epsilon, const RoomTexels& room,
             const Coverage& coverage);
    void shoot(const Scene& scene, const RayScene& rays, const RoomTexels& room,
               const SightObjects& objects);

    std::vector<Shot> shots_;
    std::vector<Ray> rays_;
    std::vector<Vec3> carried_;  ///< flux of each ray
    std::vector<std::vector<Arrival>> arrivals_;
    std::vector<TexelChange> next_;
};

}  // namespace vlf
