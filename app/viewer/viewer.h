#pragma once
// The walkthrough window: each frame it takes what the user does, moves, draws and shows.

#include "comparison.h"
#include "folder_watch.h"
#include "gui.h"
#include "live_view.h"
#include "memory.h"
#include "object_panel.h"
#include "object_pointer.h"
#include "objects.h"
#include "session.h"
#include "shown_room.h"
#include "walkthrough.h"

#include "vlf/display/frame_statistics.h"
#include "vlf/display/window.h"
#include "vlf/render/gl/exposure_meter.h"
#include "vlf/render/gl/gpu_timer.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace vlf::app {

struct ViewerOptions {
    std::string file;          ///< field or scene, for the title and names of new files
    Camera start;              ///< key 0 goes back there
    bool startChosen = false;  ///< by the user, over what is remembered
    WindowOptions window;      ///< its place, unless the user has chosen one, is the remembered one
    bool placeChosen = false;  ///< by the user
    bool samplesChosen = false;  ///< by the user; otherwise none where the CPU draws
    RendererOptions renderer;    ///< its shader folder is watched for changes
    std::size_t mode = 0;        ///< of kViewModes
    SessionOptions session;
    Scenario objects;                              ///< in the room, with their models
    ModelLibrary models;                           ///< of these
    ObjectSettings object;                         ///< of objects that are added
    LiveBake* live = nullptr;                      ///< bakes the room; must outlive the viewer
    std::shared_ptr<const IrradianceAtlas> light;  ///< in place of the room's own; null: that
    std::string output;                            ///< of the live bake, see LiveView
    std::string preferences;                       ///< file; empty: remembers nothing
    bool quiet = false;
    bool verbose = false;  ///< prints what keys have done
};

enum class Picture { png, exr };

struct Binding;

class Viewer : private WindowListener {
  public:
    /// What lies over the picture.
    struct Shown {
        bool panel = false, help = false, statistics = false;
    };

    /// Throws as Window, Renderer and Session do.
    Viewer(std::shared_ptr<const BakedRoom> room, const ViewerOptions& options);

    bool closing() const { return window_->closing() || session_.over(); }

    /// One frame, `seconds` after the one before. Throws Error if the driver was reset.
    void frame(double seconds);

    /// To be called in the end: writes what was recorded, baked and is to be remembered. Throws
    /// FileError.
    void finish();

    /// Writes down what is to be remembered.
    void remember() { memory_.save(*window_, walk_); }

    Walkthrough& walk() { return walk_; }
    Objects& objects() { return objects_; }
    ObjectPanel& objectPanel() { return objectPanel_; }
    Shown& shown() { return shown_; }
    /// Adds an object that is written as for --object; before the camera, if no place is stated.
    /// What is wrong with it is said.
    void addObject(const std::string& text);
    /// The next layout of the comparison with the room baked again.
    void compareNext() { comparison_.next(shownRoom_->shared(), objects_); }
    /// Writes the objects as a scenario of a new name.
    void saveObjects();
    /// What fails is said.
    void attempt(const std::function<void()>& action);
    void addBookmark();
    void captureMouse(bool on);
    void toggleFullscreen();
    void saveBake();
    void wantPicture(Picture kind) { pictureWanted_ = kind; }
    void escape();

  private:
    void keyPressed(const KeyPress& press) override;
    void pointerPressed(const Vec2& at) override;
    void pointerReleased(const Vec2& at) override;
    void pointerDragged(const Vec2& by, const Vec2& at) override;
    void scrolled(float steps) override;

    bool applies(const Binding& binding) const;
    bool holds(const Binding& binding) const;
    Steering steering(float seconds);
    ObjectSteering objectSteering() const;
    Vec2 pixels(const Vec2& at) const;
    Screen screen() const;
    void move(float seconds);
    void say(const std::string& text);
    void announce(const std::string& text);
    void takeNews();
    void updateObjects();
    void drawObjectGizmo();
    void reloadShaders(float seconds);
    void adaptExposure(float seconds);
    void drawRoom(float seconds);
    void drawOverlays();
    void drawMessages(float seconds);
    std::string status() const;
    void note(double pathSeconds, double cpuMs, double totalMs);
    void writeWantedPicture();
    std::string writePicture(Picture kind);
    void showTitle(float seconds);

    ViewerOptions options_;
    Memory memory_;
    std::unique_ptr<Window> window_;
    Gui gui_;
    std::unique_ptr<ShownRoom> shownRoom_;
    Walkthrough walk_;
    Session session_;
    Objects objects_;
    ObjectPanel objectPanel_;
    ObjectPointer pointer_;
    Comparison comparison_;
    std::optional<LiveView> live_;
    Shown shown_;
    FrameStatistics statistics_;
    gl::ExposureMeter meter_;
    gl::GpuTimer roomTimer_, overlayTimer_;
    FolderWatch shaderWatch_;
    Vec2 turn_{0};                     ///< by the mouse, still to be done
    std::optional<double> objectsMs_;  ///< for the light of objects in this frame
    std::optional<Picture> pictureWanted_;
    std::string message_, problem_;
    float messageAge_ = 0;                                        ///< seconds
    float sinceMetered_ = 0, sinceWatched_ = 0, sinceTitle_ = 0;  ///< seconds
};

}  // namespace vlf::app
