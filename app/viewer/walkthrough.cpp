#include "walkthrough.h"

#include "display_modes.h"

#include "vlf/image/tone_map.h"

#include <cmath>

#include <fmt/format.h>

namespace vlf::app {

namespace {

constexpr float kSpeedStep = 1.2f;

/// The exposure of a room whose walls are all grey, of reflectance 1/2.
float exposureOf(const IrradianceAtlas& atlas) {
    Image walls(static_cast<int>(atlas.width), static_cast<int>(atlas.height));
    for (std::size_t i = 0; i < walls.pixels.size(); ++i)
        walls.pixels[i] = atlas.irradiance[i] / (2 * kPi);
    return autoExposure(walls);
}

}  // namespace

Walkthrough::Walkthrough(std::shared_ptr<const BakedRoom> room, const Camera& start, Say say)
    : start_(start),
      say_(std::move(say)),
      ground_(std::make_unique<Ground>(std::move(room), poseOf(start))),
      exposure_(exposureOf(ground_->room->field.atlas)) {}

void Walkthrough::enter(std::shared_ptr<const BakedRoom> room) {
    const Navigator& before = navigator();
    auto ground = std::make_unique<Ground>(std::move(room), before.pose());
    ground->navigator.setSpeedFactor(before.speedFactor());
    ground->navigator.setEyeHeight(before.eyeHeight());
    ground->navigator.setMovement(before.movement());
    ground_ = std::move(ground);
}

void Walkthrough::recall(const Preferences& preferences, const RoomPreferences& here) {
    bookmarks_ = here.bookmarks;
    navigator().setSpeedFactor(preferences.speedFactor);
    if (here.pose) navigator().setPose(*here.pose);
    navigator().setMovement(preferences.movement);
}

RenderSettings Walkthrough::settings() const {
    RenderSettings settings;
    settings.lookup = lookup_;
    settings.tone = tone_;
    settings.exposure = exposure_.value();
    const ViewMode& mode = kViewModes[mode_];
    settings.mode = mode.mode;
    settings.normals = mode.normals;
    settings.diagram.kind = mode.diagram;
    settings.diagramCamera = diagramCamera_;
    return settings;
}

void Walkthrough::reset() {
    navigator().setPose(poseOf(start_));
    jumped_ = true;
    exposure_ = Exposure(exposureOf(ground_->room->field.atlas));
    say_("start");
}

void Walkthrough::goTo(const CameraPose& pose, const std::string& name) {
    navigator().setPose(pose);
    jumped_ = true;
    say_(name);
}

void Walkthrough::goToCamera(std::size_t number) {
    if (number < cameras().size())
        goTo(poseOf(cameras()[number]), "camera " + cameras()[number].name);
}

void Walkthrough::goToNextBookmark() {
    if (bookmarks_.empty()) return say_("no bookmarks: B adds one");
    const Bookmark& bookmark = bookmarks_[nextBookmark_++ % bookmarks_.size()];
    goTo(bookmark.pose, "bookmark " + bookmark.name);
}

void Walkthrough::addBookmark() {
    bookmarks_.push_back({fmt::format("place {}", bookmarks_.size() + 1), navigator().pose()});
    say_("bookmark " + bookmarks_.back().name + " added");
}

void Walkthrough::setMovement(Movement movement) {
    navigator().setMovement(movement);
    say_(movement == Movement::walk ? "walking" : "flying");
}

void Walkthrough::setMode(std::size_t mode) {
    mode %= kViewModes.size();
    if (mode == mode_) return;
    mode_ = mode;
    diagramCamera_ = camera();
    say_(fmt::format("mode {}: {}", kViewModes[mode_].name, kViewModes[mode_].help));
}

void Walkthrough::setLookup(LookupKind lookup) {
    lookup_ = lookup;
    say_(lookup == LookupKind::plain ? "mirrors: plain lookup" : "mirrors: corrected by depth");
}

void Walkthrough::setTone(ToneCurve tone) {
    tone_ = tone;
    say_(tone == ToneCurve::filmic ? "tone curve filmic" : "tone curve linear");
}

void Walkthrough::setAutomaticExposure(bool on) {
    exposure_.setAutomatic(on);
    say_(on ? "exposure automatic"
            : fmt::format("exposure fixed at {:+.2f} EV", exposure_.value()));
}

void Walkthrough::changeExposure(float ev) {
    exposure_.setCompensation(exposure_.compensation() + ev);
    say_(fmt::format("exposure {:+.2f} EV", exposure_.value()));
}

void Walkthrough::changeFov(float degrees) {
    navigator().setVerticalFov(navigator().pose().verticalFov + degrees);
    say_(fmt::format("field of view {:.0f} degrees", navigator().pose().verticalFov));
}

void Walkthrough::changeSpeed(float steps) {
    navigator().setSpeedFactor(navigator().speedFactor() * std::pow(kSpeedStep, steps));
    say_(fmt::format("speed x {:.2f}", navigator().speedFactor()));
}

}  // namespace vlf::app
