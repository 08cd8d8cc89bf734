#pragma once
// A walk through a room: where one is and how it is shown, and what can be done about either. Knows
// no window.

#include "vlf/display/exposure.h"
#include "vlf/display/navigation.h"
#include "vlf/display/preferences.h"
#include "vlf/io/field_file.h"
#include "vlf/render/gl/renderer.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace vlf::app {

class Walkthrough {
  public:
    /// Told in a few words what has been done.
    using Say = std::function<void(const std::string&)>;

    Walkthrough(std::shared_ptr<const BakedRoom> room, const Camera& start, Say say);

    /// Another room, or the same in another light, takes the place of this one.
    void enter(std::shared_ptr<const BakedRoom> room);

    void recall(const Preferences& preferences, const RoomPreferences& here);

    Navigator& navigator() { return ground_->navigator; }
    const Navigator& navigator() const { return ground_->navigator; }
    /// Of the room, until another is entered.
    const RayScene& rays() const { return ground_->rays; }
    Camera camera() const { return cameraOf(navigator().pose()); }
    Exposure& exposure() { return exposure_; }
    std::vector<Bookmark>& bookmarks() { return bookmarks_; }
    const std::vector<Bookmark>& bookmarks() const { return bookmarks_; }
    const std::vector<Camera>& cameras() const { return ground_->room->scene.cameras; }
    RenderSettings settings() const;

    std::size_t mode() const { return mode_; }
    LookupKind lookup() const { return lookup_; }
    ToneCurve tone() const { return tone_; }

    /// Whether the walker has been put somewhere since the last call.
    bool jumped() { return std::exchange(jumped_, false); }

    void reset();
    void goTo(const CameraPose& pose, const std::string& name);
    void goToCamera(std::size_t number);  ///< none of that number: does nothing
    void goToNextBookmark();
    void addBookmark();
    void setMovement(Movement movement);
    void setMode(std::size_t mode);  ///< beyond the last: the first
    void setLookup(LookupKind lookup);
    void setTone(ToneCurve tone);
    void setAutomaticExposure(bool on);
    void changeExposure(float ev);
    void changeFov(float degrees);
    void changeSpeed(float steps);

  private:
    /// A room to move in.
    struct Ground {
        std::shared_ptr<const BakedRoom> room;
        RayScene rays;
        Navigator navigator;

        Ground(std::shared_ptr<const BakedRoom> baked, const CameraPose& pose)
            : room(std::move(baked)), rays(room->scene), navigator(room->scene, rays, pose) {}
    };

    Camera start_;
    Say say_;
    std::unique_ptr<Ground> ground_;
    Exposure exposure_;
    std::vector<Bookmark> bookmarks_;
    std::size_t nextBookmark_ = 0;
    bool jumped_ = false;
    std::size_t mode_ = 0;
    Camera diagramCamera_;  ///< from where the diagram was asked for
    LookupKind lookup_ = LookupKind::depthCorrected;
    ToneCurve tone_ = ToneCurve::filmic;
};

}  // namespace vlf::app
