#pragma once
// Light that comes to an object along the directions of its plan.
//
// A ray that receivers share and that soon meets a flat surface of the room does not show all of
// them the same place there: each sees that surface where its own parallel to the ray meets it.
// Whether something else is nearer on that way is not asked, unless it passes the surface by.

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/gather_plan.h"
#include "vlf/dynamic/lit_room.h"
#include "vlf/dynamic/near_place.h"
#include "vlf/dynamic/sight.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

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
    void trace(const GatherPlan& plan, const ObjectReceivers& receivers, const Pose& pose,
               const LitRoom& room, const SightObjects& objects, const Coverage& coverage,
               std::span<const std::uint8_t> wanted, bool emission);

    /// Indirect irradiance at the receivers but those that the trace left out, light between parts
    /// of the object included, which `direct` light starts, too.
    void gather(const GatherPlan& plan, const ObjectReceivers& receivers,
                std::span<const Vec3> texelRadiance, std::span<const LitObject> lit,
                std::span<const Vec3> direct, std::span<Vec3> irradiance);

    /// Whether what gather() finds depends on the light of the objects it is given.
    bool seesObjects() const;

  private:
    /// Rays of some directions.
    struct Launched {
        std::vector<Ray> rays;
        std::vector<std::uint32_t> of;  ///< by ray: its launch
        std::vector<float> scale;       ///< one by the chance
        Sights sights;
    };
    struct Seen {
        std::uint32_t launch;
        float scale;  ///< one by the chance
        Sight sight;
    };
    /// One that meets a flat chart close by.
    struct NearLaunch {
        std::uint32_t launch;
        float scale;
        Ray ray;
        NearPlace place;
    };
    /// What a receiver sees instead of what its launch does.
    struct OwnTexel {
        std::uint32_t receiver, texel, ofLaunch;
        float weight;
    };
    /// Of parallels that pass the surface by that the launch meets: to be traced.
    struct OwnSights {
        std::vector<Ray> rays;
        std::vector<std::size_t> of;  ///< by ray: number among the own texels of the block
        Sights sights;
    };

    void findNeeded(const GatherPlan& plan);
    void queueLaunches(const GatherPlan& plan, const Pose& pose, float depth, std::size_t block,
                       Launched& launched) const;
    void keepSights(const Launched& launched, const Coverage& coverage, bool emission,
                    std::size_t block);
    void findOwnTexels(const GatherPlan& plan, const ObjectReceivers& receivers, const Pose& pose,
                       const LitRoom& room, const SightObjects& objects, const Coverage& coverage);
    void shiftLaunches(const GatherPlan& plan, const ObjectReceivers& receivers, std::size_t r,
                       const Pose& pose, const RoomTexels& room, std::vector<OwnTexel>& own,
                       OwnSights& passed) const;
    static void traceOwn(const LitRoom& room, const SightObjects& objects,
                         std::vector<OwnTexel>& own, OwnSights& passed);
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
    std::vector<std::vector<Seen>> others_;         ///< by block of directions
    std::vector<std::vector<NearLaunch>> near_;     ///< likewise
    std::vector<const NearLaunch*> nearOf_;         ///< by launch; null: it is not
    std::vector<std::vector<OwnTexel>> ownTexels_;  ///< by block of receivers, in their order
    std::vector<Vec4> outside_;  ///< by receiver: irradiance from without; that of unit radiance
                                 ///< from an entry of unit weight
    std::vector<Vec4> ownRadiance_;  ///< by receiver
    std::vector<Vec4> radiance_;     ///< by launch; w: 1, or 0 where it is no sample
};

}  // namespace vlf
