#pragma once
// The objects in a walkthrough: what there is, how it moves, which one is held, and what can be
// done with them. Knows no window.

#include "vlf/dynamic/scenario.h"
#include "vlf/io/field_file.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vlf::app {

/// Whom the keys move.
enum class Subject { camera, object };

/// What the user wants of an object for the next moment.
struct ObjectSteering {
    Vec3 push{0};       ///< along its own axes; each in [-1, 1]
    Vec2 spin{0};       ///< about its own Y and X, counter-clockwise; each in [-1, 1]
    bool fast = false;  ///< three times as fast

    bool any() const { return push != Vec3(0) || spin != Vec2(0); }
};

/// Numbers of objects are those of scenario().objects and of the DynamicRoom.
class Objects {
  public:
    /// Told in a few words what has been done.
    using Say = std::function<void(const std::string&)>;
    /// Shows objects whose light has been found anew.
    using Show = std::function<void(const DynamicRoom&)>;

    /// `scenario` has its models.
    Objects(Scenario scenario, ModelLibrary library, Say say);

    /// They are now in this room, whose `rays` must live until they enter another; `light`, in
    /// place of the room's own, may be null. Throws InputError if an object that is or comes to be
    /// seen cannot be lit (DynamicRoom::update).
    void enter(std::shared_ptr<const BakedRoom> room, const RayScene& rays,
               std::shared_ptr<const IrradianceAtlas> light);
    /// The room's light is another one, of the same charts.
    void setLight(std::shared_ptr<const IrradianceAtlas> light);

    /// Moves what moves by itself to where it is at a time, s, finds the light as it is seen from
    /// `eye` and shows it, if anything has changed; returns whether it has. Objects that have been
    /// changed so that they cannot be lit, or shown (`show` throws InputError), are then as they
    /// were, and it is said why.
    bool update(double seconds, const Vec3& eye, const Show& show);

    /// Null as long as there has been no object.
    const DynamicRoom* room() const { return dynamic_.get(); }
    const Scenario& scenario() const { return scenario_; }
    std::size_t size() const { return scenario_.objects.size(); }
    /// As it is now.
    const DynamicObject& now(std::size_t i) const { return dynamic_->object(i); }
    std::vector<DynamicObject> visible() const;  ///< as they are now
    const std::string& name(std::size_t i) const { return scenario_.objects[i].object.name; }
    /// A number that no other object ever has.
    std::uint64_t id(std::size_t i) const { return ids_[i]; }
    /// It has been there in an update().
    bool shown(std::size_t i) const;

    Subject subject() const { return subject_; }
    void toggleSubject();
    std::optional<std::size_t> selected() const { return selected_; }
    void select(std::optional<std::size_t> i);
    void selectNext();  ///< of the visible ones
    bool playing() const { return playing_; }
    void setPlaying(bool on);

    /// Moves the selected object for some seconds; its motion, if it has one, ends.
    void steer(const ObjectSteering& steering, float seconds);
    /// The first object along a ray that the room does not hide.
    std::optional<std::size_t> pick(const Ray& ray) const;
    /// A place for an object of some radius, metres, seen along a ray.
    Vec3 placeAlong(const Ray& ray, float radius) const;

    /// Adds the object, under a name of its own, and selects it. Throws as ModelLibrary::model.
    void add(ScenarioObject object);
    void duplicate(std::size_t i);
    void remove(std::size_t i);
    void setPose(std::size_t i, Pose pose);        ///< its motion, if it has one, ends
    void setVisible(std::size_t i, bool visible);  ///< at every keyframe of its motion
    void setSettings(std::size_t i, const ObjectSettings& settings);
    /// With a number behind it if another has it; an empty one changes nothing.
    void setName(std::size_t i, const std::string& name);
    /// Of diffuse and mirror reflectance that exceed 1 together the one that is as before gives
    /// way. Throws as ModelLibrary::model; the object is then as it was.
    void setSource(std::size_t i, ObjectSource source);

  private:
    void build();
    void insert(ScenarioObject object);
    void erase(std::size_t i);
    std::optional<std::size_t> indexOf(std::uint64_t id) const;
    std::optional<std::size_t> nextVisible() const;
    void sayNoneIsVisible() const;
    void keep(std::size_t i);
    void takeBack();
    bool light(const Show& show);
    void findLight();

    Scenario scenario_;
    ModelLibrary library_;
    Say say_;
    std::shared_ptr<const BakedRoom> room_;
    const RayScene* rays_ = nullptr;
    std::shared_ptr<const IrradianceAtlas> light_;
    std::unique_ptr<DynamicRoom> dynamic_;
    bool unshown_ = false;  ///< lit anew, not shown yet
    std::vector<std::uint64_t> ids_;
    std::vector<std::uint64_t> litIds_;  ///< of dynamic_->litObjects()
    std::uint64_t lastId_ = 0;
    /// By id, how objects were that have been changed since update(); none: not there.
    std::map<std::uint64_t, std::optional<ScenarioObject>> before_;
    Subject subject_ = Subject::camera;
    std::optional<std::size_t> selected_;
    bool playing_ = true;
    double playedSeconds_ = 0, pausedSeconds_ = 0;
};

}  // namespace vlf::app
