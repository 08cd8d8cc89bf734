#pragma once
// A walk through a room: where one is and how it is shown, and what can be done about either. Knows
// no window.

#include "vlf/display/exposure.h"
#include "vlf/display/navigation.h"
#include "vlf/display/preferences.h"
#include "vlf/io/field_file.h"
#include "vlf/render/gl/renderer.h"

#include <functional>
#include <string>
#include <vector>

namespace vlf::app {

class Walkthrough {
  public:
    /// Told in a few words what has been done.
    using Say = std::function<void(const std::string&)>;

    /// `room` must outlive it.
    Walkthrough(const BakedRoom& room, const Camera& start, Say say);

    void recall(const Preferences& preferences, const RoomPreferences& here);

    Navigator& navigator() { return navigator_; }
    const Navigator& navigator() const { return navigator_; }
    Camera camera() const { return cameraOf(navigator_.pose()); }
    Exposure& exposure() { return exposure_; }
    std::vector<Bookmark>& bookmarks() { return bookmarks_; }
    const std::vector<Bookmark>& bookmarks() const { return bookmarks_; }
    const std::vector<Camera>& cameras() const { return room_.scene.cameras; }
    RenderSettings settings() const;

    std::size_t mode() const { return mode_; }
    LookupKind lookup() const { return lookup_; }
    ToneCurve tone() const { return tone_; }

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
    const BakedRoom& room_;
    Camera start_;
    Say say_;
    RayScene rays_;
    Navigator navigator_;
    Exposure exposure_;
    std::vector<Bookmark> bookmarks_;
    std::size_t nextBookmark_ = 0;
    std::size_t mode_ = 0;
    LookupKind lookup_ = LookupKind::depthCorrected;
    ToneCurve tone_ = ToneCurve::filmic;
};

}  // namespace vlf::app
