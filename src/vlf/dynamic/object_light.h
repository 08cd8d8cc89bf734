#pragma once
// The light on one object.

#include "vlf/dynamic/delta_transport.h"
#include "vlf/dynamic/gather_sights.h"
#include "vlf/dynamic/incident_light.h"
#include "vlf/dynamic/irradiance_cache.h"
#include "vlf/dynamic/object_emitters.h"
#include "vlf/dynamic/object_plan.h"
#include "vlf/dynamic/point_lights.h"

#include <memory>
#include <span>
#include <vector>

namespace vlf {

/// The room around objects, and the other objects.
struct Surroundings {
    LitRoom room;                    ///< without objects
    std::span<const Vec3> radiance;  ///< of it with them
    const RayInstances& instances;
    std::span<const LitObject> lit;
    const Coverage& coverage;
    const IncidentLightFinder& incident;
    const PointLighting& points;
    std::span<const std::unique_ptr<const ObjectEmitters>> emitters;  ///< of the lit objects
    std::span<const Vec3> viewers;  ///< from where objects are seen; empty: from anywhere
    Vec3 meanIrradiance{0};
};

class ObjectLight {
  public:
    /// `number`: among all there ever were of a room; tells versions of LitObject apart.
    explicit ObjectLight(std::uint32_t number) { lit_.version = std::uint64_t{number} << 32; }

    struct Plans {
        std::shared_ptr<const ObjectPlan> plan;
        std::shared_ptr<const LinesPlan> lines;  ///< null: it does not change the room
    };
    /// What the object's settings ask for. `roomCell`: width of a cell of the field, `roomTexel`:
    /// of its texels, m. Throws InputError as Unwrap and ObjectModel::mesh.
    static Plans makePlans(const DynamicObject& object, ObjectPlans& plans, int lines,
                           float roomCell, float roomTexel);

    /// Makes ready to light the object by its plans.
    void prepare(const DynamicObject& object, Plans plans);

    const LitObject& lit() const { return lit_; }

    /// Whether a viewer sees parts of it that the last look left out.
    bool misses(const DynamicObject& object, std::span<const Vec3> viewers) const;

    /// The emitters of the object, as number `own` of the lit ones; null: it does not emit.
    std::unique_ptr<const ObjectEmitters> emitters(const DynamicObject& object, const LitRoom& room,
                                                   std::uint32_t own) const;

    /// What was gathered before holds no longer.
    void forget() { cache_.clear(); }

    /// Looks about from the object's pose, as number `own` of the lit ones.
    void look(const DynamicObject& object, const Surroundings& around, std::uint32_t own);

    /// What is seen of it until find(), and where its light is not sought after that: `irradiance`
    /// everywhere.
    void guess(const Vec3& irradiance);

    /// Of shading `prt`: the light that comes to it. Reads the light on other objects, which must
    /// not change meanwhile.
    void findIncident(const DynamicObject& object, const Surroundings& around);

    /// The light on it, by what the surroundings now send; of shading `prt`, what findIncident()
    /// has found.
    void find(const DynamicObject& object, const Surroundings& around);

    /// Whether find() depends on the light of the objects, by what it has seen since look().
    bool seesObjects() const;

    /// Whether it takes from the room's indirect light and gives it back.
    bool changesRoom() const { return lines_ != nullptr; }

    /// Adds how it changes the room's irradiance; see DeltaLines::addTo.
    void addChange(RoomChange& change) const;

  private:
    bool showsTo(const DynamicObject& object, std::size_t receiver,
                 std::span<const Vec3> viewers) const;
    void findWanted(const DynamicObject& object, std::span<const Vec3> viewers);
    void lookForGather(const DynamicObject& object, const Surroundings& around,
                       const SightObjects& objects);
    void findDirect(const DynamicObject& object, const Surroundings& around);
    void gather(const DynamicObject& object, const Surroundings& around);
    void publish();

    std::shared_ptr<const ObjectPlan> plan_;
    std::shared_ptr<const LinesPlan> lines_;
    std::uint32_t number_ = kNoObject;  ///< among the lit ones
    std::vector<std::uint8_t> wanted_;  ///< by receiver; empty: all
    std::vector<std::uint8_t> traced_;  ///< wanted and not in the cache
    IrradianceCache cache_;             ///< of what is gathered
    GatherSights sights_;
    IncidentLight incident_;
    std::unique_ptr<IncidentLightFinder::Scratch> scratch_;
    DeltaLines delta_;
    std::vector<Vec3> direct_, irradiance_, radiance_;  ///< by receiver
    IrradianceAtlas atlas_;
    LitObject lit_;
};

}  // namespace vlf
