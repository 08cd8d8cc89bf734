#pragma once
// Irradiance of an object gathered over a direction set (Wither 2005, section "advanced shading"):
//
//     E(p) = π Σ_k L(p, ω_k) (n·ω_k)⁺ w_k / Σ_k (n·ω_k)⁺ w_k,
//
// L being what leaves the first surface seen from p along ω_k. Directions that see out of the room
// are black and count; those that start within a solid are no samples. The set turns with the
// object, so that which part of it hides or shows which is found once.
//
// Neighbours see almost the same: receivers that lie close together and face alike share, for each
// direction, the ray of the one in their middle. gather_sights.h follows it.

#include "vlf/dynamic/object_receivers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

struct GatherPlanParams {
    int lines = 513;
    int step = 1;           ///< only every step-th direction
    float cellsAcross = 4;  ///< patches that share rays, over the diameter of the object; 0: a ray
                            ///< of its own for each receiver and direction
};

/// Model space; shared by all objects of one model and settings.
struct GatherPlan {
    /// Where a receiver's light from one direction comes from: a launch, or another receiver.
    struct Entry {
        std::uint32_t from = 0;
        float weight = 0;  ///< (n·ω)⁺ w
    };
    /// Those of receiver r: from[first[r]] on.
    struct Entries {
        std::vector<std::uint32_t> first;
        std::vector<Entry> all;

        std::span<const Entry> of(std::size_t r) const {
            return {all.data() + first[r], all.data() + first[r + 1]};
        }
    };

    std::vector<Vec3> directions;            ///< oriented, unit
    float patch = 0;                         ///< metres, width of what shares launches; 0: nothing
    std::vector<std::uint32_t> firstLaunch;  ///< launches of direction d: firstLaunch[d] on
    std::vector<Vec3> launches;              ///< points on the object
    Entries outside;                         ///< from launches
    Entries inside;                          ///< from receivers: parts of the object that are seen
};

GatherPlan makeGatherPlan(const ObjectReceivers& receivers, const Sphere& bounds,
                          const GatherPlanParams& params);

}  // namespace vlf
