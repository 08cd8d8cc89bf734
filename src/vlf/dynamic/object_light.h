#pragma once
// The light on one object.

#include "vlf/dynamic/delta_transport.h"
#include "vlf/dynamic/object_plan.h"

#include <memory>
#include <span>
#include <vector>

namespace vlf {

/// The room around objects, and the other objects.
struct Surroundings {
    const Scene& scene;
    const RayScene& rays;
    const RoomTexels& room;
    std::span<const Vec3> roomRadiance;  ///< by atlas texel, without objects, W·m⁻²·sr⁻¹
    std::span<const Vec3> radiance;      ///< the same with them
    const RayInstances& instances;
    std::span<const LitObject> lit;
    const Coverage& coverage;
    Vec3 meanIrradiance{0};
};

class ObjectLight {
  public:
    /// Makes ready what the object's settings ask for. `roomCell`: width of a cell of the field, m.
    void prepare(const DynamicObject& object, ObjectPlans& plans, int lines, float roomCell);

    const LitObject& lit() const { return lit_; }

    /// Looks about from the object's pose. `own`: its number among the lit ones.
    void look(const DynamicObject& object, const Surroundings& around, std::uint32_t own);

    /// The light on it, by what the surroundings now send.
    void find(const DynamicObject& object, const Surroundings& around);

    /// Adds how it changes the room's irradiance; see DeltaLines::addTo.
    void addChange(std::span<Vec3> change, std::span<std::uint8_t> touched,
                   std::vector<std::uint32_t>& texels);

  private:
    void findDirect(const DynamicObject& object, const Surroundings& around);
    void publish();

    std::shared_ptr<const ObjectPlan> plan_;
    std::shared_ptr<const LinesPlan> lines_;
    GatherSights sights_;
    DeltaLines delta_;
    std::vector<Vec3> direct_, own_, irradiance_, radiance_;  ///< by receiver
    IrradianceAtlas atlas_;
    LitObject lit_;
};

/// The objects in the way of light.
ExtraOccluder occluderOf(const RayInstances& instances);

}  // namespace vlf
