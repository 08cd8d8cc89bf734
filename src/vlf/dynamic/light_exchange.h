#pragma once
// The light between a baked room and the objects in it: the main algorithm of dynamic light.

#include "vlf/dynamic/change_bounce.h"
#include "vlf/dynamic/change_sweep.h"
#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/object_light.h"
#include "vlf/dynamic/room_change.h"
#include "vlf/dynamic/soft_shadow.h"
#include "vlf/dynamic/update_times.h"
#include "vlf/field/light_field.h"

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace vlf {

/// An object that is in the room now.
struct Body {
    const DynamicObject* object = nullptr;
    ObjectLight* light = nullptr;  ///< prepared
    bool stale = true;             ///< it, or what it sees, is another than in the exchange before
};

class LightExchange {
  public:
    /// What it refers to must outlive it. Throws InputError if the field is not of the scene.
    LightExchange(const Scene& scene, const RayScene& rays, const LightField& field);
    LightExchange(const LightExchange&) = delete;
    LightExchange& operator=(const LightExchange&) = delete;

    /// The room's own light, of the field's charts.
    void setRoomLight(const IrradianceAtlas& atlas);

    /// Finds all light anew, but looks about only from bodies that are stale. `viewers`: from where
    /// objects are seen; none: from anywhere.
    void run(std::span<const Body> bodies, std::span<const Vec3> viewers);

    const std::vector<LitObject>& lit() const { return lit_; }
    const RayInstances& rays() const { return instances_; }
    const IrradianceAtlas& light() const { return light_; }
    const IrradianceAtlas& roomLight() const { return roomLight_; }
    const PointLighting& pointLighting() const { return points_; }
    const RoomTexels& texels() const { return texels_; }
    const UpdateTimes& times() const { return times_; }

  private:
    void place();
    void findPointLights();
    void findEmitters();
    void findShadows();
    void shadeRoom();
    void exchange(const Surroundings& around);
    void changeRoom(bool bouncing);
    void findObjectLight(const Surroundings& around);
    void findOthersLight(const Surroundings& around);
    void findLightOfSeers(const Surroundings& around);
    bool isDue(const Body& body) const;
    LitRoom litRoom() const { return {scene_, roomRays_, texels_, roomRadiance_}; }

    const Scene& scene_;
    const RayScene& roomRays_;
    RoomTexels texels_;
    IncidentLightFinder incident_;
    IrradianceAtlas roomLight_, light_;  ///< without objects and with them
    std::vector<Vec3> roomRadiance_, radiance_;
    bool radianceKnown_ = false;         ///< radiance_ is up to date
    std::vector<Vec3> shadedRadiance_;   ///< of the room without direct light that objects block
    std::vector<std::uint32_t> shaded_;  ///< texels where that is another
    Vec3 meanIrradiance_{0};
    float roomFlux_ = 0;  ///< that the texels send, of the brightest channel, W
    PointLighting points_;
    bool pointsKnown_ = false;

    std::vector<Body> bodies_;
    std::vector<LitObject> lit_;
    std::vector<Sphere> spheres_;               ///< around them
    RayInstances instances_, casterInstances_;  ///< of all; of those whose shadows are sampled
    std::vector<RayInstance> placed_, casters_;
    std::vector<ShadowCaster> shadowCasters_;
    std::vector<std::unique_ptr<const ObjectEmitters>> emitters_;

    Coverage coverage_;
    RoomChange change_;
    SoftShadows softShadows_;
    std::vector<TexelChange> shadows_, emitted_;
    std::vector<std::pair<std::uint32_t, Vec3>> weakShadows_;  ///< of all texels of a group
    BounceRays bounceRays_;                                    ///< once something bounces
    ChangeBounce bounce_;
    std::optional<ChangeSweep> sweep_;                  ///< once an object emits
    bool roomChanges_ = false, changedBefore_ = false;  ///< by objects, now or in the run before
    UpdateTimes times_;
};

}  // namespace vlf
