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
// direction, the ray of the one in their middle.

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/lit_room.h"
#include "vlf/dynamic/object_receivers.h"
#include "vlf/dynamic/sight.h"

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
    /// Where a receiver's light from one direction comes from.
    struct Entry {
        std::uint32_t from = 0;  ///< launch; or, with kSelf, the receiver that is seen there
        float weight = 0;        ///< (n·ω)⁺ w
    };
    static constexpr std::uint32_t kSelf = 1u << 31;

    std::vector<Vec3> directions;               ///< oriented, unit
    std::vector<std::uint32_t> firstLaunch;     ///< launches of direction d: firstLaunch[d] on
    std::vector<Vec3> launches;                 ///< points on the object
    std::vector<std::uint32_t> launchReceiver;  ///< the receiver that each is at
    std::vector<std::uint32_t> firstEntry;      ///< entries of receiver r: firstEntry[r] on
    std::vector<Entry> entries;
};

GatherPlan makeGatherPlan(const ObjectReceivers& receivers, const Sphere& bounds,
                          const GatherPlanParams& params);

/// What the launches of a plan see, to be turned into light as often as that changes.
class GatherSights {
  public:
    /// Traces them for an object in this pose. `wanted`, by receiver: 0 where light need not be
    /// known; empty: everywhere. `emission`: of the room's emitters as they are met;
    /// otherwise only where direct light does not have it.
    void trace(const GatherPlan& plan, const Pose& pose, const LitRoom& room,
               const SightObjects& objects, const Coverage& coverage,
               std::span<const std::uint8_t> wanted, bool emission);

    /// Irradiance at the receivers, added to what is in `irradiance`, but for those that the trace
    /// left out. `own`: irradiance at the receivers as parts of the object see it.
    void gather(const GatherPlan& plan, const ObjectReceivers& receivers,
                std::span<const Vec3> texelRadiance, std::span<const LitObject> lit,
                std::span<const Vec3> own, std::span<Vec3> irradiance);

  private:
    struct Seen {
        std::uint32_t launch;
        Sight sight;
    };

    bool wants(std::size_t receiver) const { return wanted_.empty() || wanted_[receiver]; }
    void findRadiance(std::span<const Vec3> texelRadiance, std::span<const LitObject> lit);

    std::vector<std::uint8_t> wanted_;
    std::vector<std::uint32_t> texel_;  ///< by launch: seen at once and without emission
    std::vector<std::uint8_t> valid_;
    std::vector<std::vector<Seen>> others_;  ///< by block
    std::vector<Vec3> ownRadiance_;          ///< by receiver
    std::vector<Vec4> radiance_;             ///< by launch; w: 1, or 0 where it is no sample
};

}  // namespace vlf
