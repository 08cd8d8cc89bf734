#pragma once
// Objects in a baked room, and the light between room and objects.

#include "vlf/dynamic/lit_object.h"
#include "vlf/dynamic/object.h"
#include "vlf/dynamic/point_lights.h"
#include "vlf/dynamic/update_times.h"
#include "vlf/field/light_field.h"
#include "vlf/trace/ray_instances.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace vlf {

/// Change it, update(), then read. Not for several threads at once; reading is.
class DynamicRoom {
  public:
    /// What it refers to must outlive it. Throws InputError if the field is not of the scene.
    DynamicRoom(const Scene& scene, const RayScene& rays, const LightField& field);
    ~DynamicRoom();
    DynamicRoom(DynamicRoom&&) noexcept;
    DynamicRoom& operator=(DynamicRoom&&) noexcept;

    /// Objects are numbered as they come; removing one moves up those behind it. Poses and settings
    /// that are out of range throw InputError and change nothing.
    std::size_t size() const;
    const DynamicObject& object(std::size_t i) const;
    void add(DynamicObject object);
    void remove(std::size_t i);
    void setPose(std::size_t i, const Pose& pose);
    void setSettings(std::size_t i, const ObjectSettings& settings);
    void setModel(std::size_t i, std::shared_ptr<const ObjectModel> model);
    void setVisible(std::size_t i, bool visible);

    /// From where objects are seen, straight or in a mirror of the room: light need not be known
    /// elsewhere (GatherSettings::onlyVisible). None: from anywhere; as where mirrors of the room
    /// are curved or show one another, or an object mirrors.
    void setViewers(std::span<const Vec3> eyes);

    /// The room's own light is another one, of the same charts.
    void setRoomIrradiance(const IrradianceAtlas& atlas);

    /// Finds the light anew where something has changed. Returns whether anything did. Throws
    /// InputError if an object cannot be lit as its settings say (texels too small, too many
    /// triangles); the light is as before then, and the next call tries again.
    bool update();

    /// One by one the objects that are visible, and the number of each.
    std::span<const LitObject> litObjects() const;
    std::span<const std::size_t> litNumbers() const;

    /// Rays among litObjects(), in their order.
    const RayInstances& rays() const;

    /// The room's irradiance with the objects in it, and without.
    const IrradianceAtlas& irradiance() const;
    const IrradianceAtlas& roomIrradiance() const;
    std::uint64_t irradianceVersion() const;

    /// How irradiance in the room is changed by `hard` shadows is not in irradiance(): renderers
    /// lay them over, of every lit object whose settings say so, away from this light.
    const PointLight* hardShadowLight() const;

    /// Of the last update that found something changed.
    const UpdateTimes& updateTimes() const;

    const Scene& scene() const;
    const LightField& field() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vlf
