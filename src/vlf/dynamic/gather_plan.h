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
    std::vector<std::uint32_t> firstLaunch;  ///< launches of direction d: firstLaunch[d] on
    std::vector<Vec3> launches;              ///< points on the object
    Entries outside;                         ///< from launches
    Entries inside;                          ///< from receivers: parts of the object that are seen
};

GatherPlan makeGatherPlan(const ObjectReceivers& receivers, const Sphere& bounds,
                          const GatherPlanParams& params);

/// What the launches of a plan see, to be turned into light as often as that changes.
class GatherSights {
  public:
    /// Of the directions about `count` are to be followed, picked by how bright it is along them
    /// from `centre` (model space); the others' share is made up for, without bias. To be called
    /// before each trace; a count of 0 picks all.
    void pickDirections(const GatherPlan& plan, const Vec3& centre, int count, const Pose& pose,
                        const LitRoom& room, const SightObjects& objects);

    /// Traces them for an object in this pose. `wanted`, by receiver: 0 where light need not be
    /// known; empty: everywhere. `emission`: of the room's emitters as they are met;
    /// otherwise only where direct light does not have it.
    void trace(const GatherPlan& plan, const Pose& pose, const LitRoom& room,
               const SightObjects& objects, const Coverage& coverage,
               std::span<const std::uint8_t> wanted, bool emission);

    /// Indirect irradiance at the receivers but those that the trace left out, light between parts
    /// of the object included, which `direct` light starts, too.
    void gather(const GatherPlan& plan, const ObjectReceivers& receivers,
                std::span<const Vec3> texelRadiance, std::span<const LitObject> lit,
                std::span<const Vec3> direct, std::span<Vec3> irradiance);

  private:
    struct Seen {
        std::uint32_t launch;
        float scale;  ///< one by the chance
        Sight sight;
    };

    void findNeeded(const GatherPlan& plan);
    bool wants(std::size_t receiver) const { return wanted_.empty() || wanted_[receiver]; }
    float chance(std::size_t direction) const { return chances_.empty() ? 1 : chances_[direction]; }
    void reflectWithin(const GatherPlan& plan, const ObjectReceivers& receivers,
                       std::span<const Vec3> direct, std::span<Vec3> irradiance);
    void findRadiance(const GatherPlan& plan, std::span<const Vec3> texelRadiance,
                      std::span<const LitObject> lit);

    std::vector<float> chances_;  ///< by direction, of being followed; 0: is not; empty: all are
    std::vector<std::uint8_t> wanted_;  ///< by receiver; empty: all are
    std::vector<std::uint8_t> needed_;  ///< by launch: a wanted receiver shares it; empty: all are
    std::vector<std::uint32_t> texel_;  ///< by launch: seen at once and without emission
    std::vector<std::uint8_t> valid_;
    std::vector<std::vector<Seen>> others_;  ///< by block
    std::vector<Vec4> outside_;  ///< by receiver: irradiance from without; that of unit radiance
                                 ///< from an entry of unit weight
    std::vector<Vec3> ownRadiance_;  ///< by receiver
    std::vector<Vec4> radiance_;     ///< by launch; w: 1, or 0 where it is no sample
};

}  // namespace vlf
