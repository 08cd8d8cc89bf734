#pragma once
// Changed light bounces on: what objects change of a texel's irradiance, the others get to feel
// (progressive radiosity on the change alone; Cohen et al., "A progressive refinement approach to
// fast radiosity image generation", SIGGRAPH 1988).

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/room_change.h"
#include "vlf/dynamic/sight.h"

namespace vlf {

struct BounceParams {
    int rays = 4096;         ///< a bounce, dealt out by flux
    int bounces = 2;         ///< at most
    float tolerance = 0.02f;  ///< of the first bounce's flux: with less it ends
};

/// Adds to `change` what it makes the texels send one another.
void bounceChange(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                  const Coverage& coverage, const SightObjects& objects,
                  const BounceParams& params, RoomChange& change);

}  // namespace vlf
