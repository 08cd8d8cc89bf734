#include "viewer.h"

#include "console.h"
#include "gizmo_drawing.h"
#include "gpu_options.h"
#include "key_bindings.h"
#include "numbered_file.h"
#include "object_options.h"
#include "overlay.h"
#include "panel.h"
#include "stopwatch.h"

#include "vlf/base/error.h"
#include "vlf/dynamic/scenario_file.h"
#include "vlf/image/image_io.h"
#include "vlf/render/gl/driver.h"
#include "vlf/render/gl/read_framebuffer.h"
#include "vlf/render/gl/still.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace vlf::app {

namespace {

constexpr float kRadiansPerPixel = 0.003f;
constexpr float kLongestFrame = 0.1f;     // seconds; a stall is no leap
constexpr float kMetering = 0.1f;         // seconds between looks at the exposure
constexpr float kWatching = 0.25f;        // ... at the shaders
constexpr float kTitle = 0.5f;            // ... at the title
constexpr float kMessage = 3, kFade = 1;  // seconds a message stays, and fades in the end
constexpr const char* kHint = "Tab: settings   H: keys   Escape: close";

std::unique_ptr<Window> openWindow(const ViewerOptions& options, const Memory& memory) {
    WindowOptions wanted = options.window;
    wanted.title = options.file;
    if (!options.placeChosen && memory.preferences().window)
        wanted.place = *memory.preferences().window;
    auto window = std::make_unique<Window>(wanted);
    if (wanted.samples == 0 || options.samplesChosen || !gl::drawsOnCpu()) return window;
    // Who draws is known only now.
    wanted.samples = 0;
    window.reset();
    return std::make_unique<Window>(wanted);
}

std::string stemOf(const std::string& file) {
    return std::filesystem::path(file).stem().string();
}

/// True every so often.
bool due(float& since, float seconds, float interval) {
    since += seconds;
    return since >= interval && std::exchange(since, 0.0f) > 0;
}

bool held(const Window& window, const Binding& binding) {
    return std::any_of(binding.keys.begin(), binding.keys.end(),
                       [&](Key key) { return window.held(key); });
}

bool matches(const Binding& binding, const KeyPress& press) {
    return binding.press && binding.control.value_or(press.control) == press.control &&
           binding.shift.value_or(press.shift) == press.shift &&
           (binding.repeats || !press.repeated) &&
           std::count(binding.keys.begin(), binding.keys.end(), press.key) > 0;
}

}  // namespace

Viewer::Viewer(std::shared_ptr<const BakedRoom> room, const ViewerOptions& options)
    : options_(options),
      memory_(options.preferences, options.file, options.quiet),
      window_(openWindow(options, memory_)),
      gui_(*window_),
      shownRoom_(std::make_unique<ShownRoom>(room, options.renderer)),
      walk_(room, options.start, [this](const std::string& text) { say(text); }),
      session_(options.session),
      objects_(options.objects, options.models, [this](const std::string& text) { say(text); }),
      objectPanel_(*this),
      pointer_(objects_),
      comparison_(options.renderer, [this](const std::string& text) { say(text); }),
      shaderWatch_(options.renderer.shaderFolder) {
    RoomPreferences here = memory_.room();
    if (options.startChosen) here.pose.reset();
    printNotices(options.quiet, shownRoom_->renderer());
    walk_.recall(memory_.preferences(), here);
    walk_.setMode(options.mode);
    if (session_.pose()) walk_.navigator().setMovement(Movement::fly);
    objects_.enter(room, walk_.rays(), options.light);
    if (options.light) shownRoom_->renderer().updateIrradiance(*options.light);
    if (options.live)
        live_.emplace(*options.live, stemOf(options.file), options.output,
                      [this](const std::string& text) { announce(text); });
    message_ = kHint;
    messageAge_ = -kMessage;
}

void Viewer::frame(double seconds) {
    const Stopwatch watch;
    const float step = std::min(static_cast<float>(session_.advance(seconds)), kLongestFrame);
    const double pathSeconds = session_.seconds();
    window_->poll(*this);
    move(step);
    takeNews();
    if (window_->hidden()) return;
    statistics_.add(seconds);
    reloadShaders(step);
    updateObjects();
    drawRoom(step);
    adaptExposure(step);
    writeWantedPicture();
    gui_.begin(shown_.panel && !window_->pointerCaptured());
    drawMessages(static_cast<float>(seconds));
    drawOverlays();
    const double cpuMs = watch.milliseconds();
    window_->swap();
    note(pathSeconds, cpuMs, watch.milliseconds());
    showTitle(static_cast<float>(seconds));
    if (gl::contextLost())
        throw Error(
            "the graphics driver was reset and with it everything on the GPU; start again, or make "
            "pictures with vlf render");
}

void Viewer::move(float seconds) {
    const Steering wanted = steering(seconds);
    if (const auto pose = session_.pose())
        walk_.navigator().setPose(*pose);
    else
        walk_.navigator().advance(wanted, seconds);
    objects_.steer(objectSteering(), seconds);
}

void Viewer::takeNews() {
    if (!live_) return;
    const std::optional<LiveUpdate> update = live_->poll();
    if (!update) return;
    if (update->room) {
        shownRoom_ = std::make_unique<ShownRoom>(update->room, options_.renderer);
        walk_.enter(update->room);
        objects_.enter(update->room, walk_.rays(), update->irradiance);
    } else {
        objects_.setLight(update->irradiance);
    }
    shownRoom_->renderer().updateIrradiance(*update->irradiance);
}

void Viewer::updateObjects() {
    objectsMs_.reset();
    const Stopwatch watch;
    objects_.update(session_.pathSeconds(), walk_.camera().eye, [this](const DynamicRoom& room) {
        shownRoom_->renderer().updateObjects(room);
    });
    if (objects_.room()) objectsMs_ = watch.milliseconds();
    comparison_.update(shownRoom_->shared(), objects_);
}

void Viewer::note(double pathSeconds, double cpuMs, double totalMs) {
    const std::optional<double> room = roomTimer_.milliseconds();
    const std::optional<double> overlay = overlayTimer_.milliseconds();
    FrameRecord frame;
    frame.pathSeconds = pathSeconds;
    frame.cpuMs = cpuMs;
    if (room && overlay) frame.gpuMs = *room + *overlay;
    frame.totalMs = totalMs;
    frame.passMs = {objectsMs_, room, overlay};
    frame.pose = walk_.navigator().pose();
    session_.note(frame, walk_.jumped(), objects_);
}

void Viewer::finish() {
    remember();
    session_.finish();
    if (live_) live_->finish();
}

/// Of what the keys move now.
bool Viewer::applies(const Binding& binding) const {
    return binding.subject.value_or(objects_.subject()) == objects_.subject();
}

bool Viewer::holds(const Binding& binding) const {
    const bool control = window_->held(Key::leftControl) || window_->held(Key::rightControl);
    return !gui_.typing() && applies(binding) && binding.control.value_or(control) == control &&
           held(*window_, binding);
}

Steering Viewer::steering(float seconds) {
    Steering steering;
    steering.turn = std::exchange(turn_, Vec2(0));
    for (const Binding& binding : keyBindings())
        if (holds(binding)) {
            steering.go += binding.go;
            steering.fast = steering.fast || binding.fast;
        }
    if (const auto pad = window_->gamepad()) steering += steeringOf(*pad, seconds);
    return steering;
}

ObjectSteering Viewer::objectSteering() const {
    ObjectSteering steering;
    for (const Binding& binding : keyBindings())
        if (holds(binding)) {
            steering.push += binding.push;
            steering.spin += binding.spin;
            steering.fast = steering.fast || binding.fast;
        }
    return steering;
}

void Viewer::keyPressed(const KeyPress& press) {
    if (gui_.typing()) return;
    // A key may change whom the keys move: that is for the next one.
    const Subject subject = objects_.subject();
    for (const Binding& binding : keyBindings())
        if (binding.subject.value_or(subject) == subject && matches(binding, press))
            binding.press(*this);
}

Vec2 Viewer::pixels(const Vec2& at) const {
    return at * Vec2(window_->pixelWidth(), window_->pixelHeight());
}

Screen Viewer::screen() const {
    return {walk_.camera(), pixels(Vec2(1))};
}

void Viewer::pointerPressed(const Vec2& at) {
    if (!gui_.wantsPointer() && !window_->pointerCaptured() && !comparison_.shown())
        pointer_.press(screen(), pixels(at), window_->contentScale());
}

void Viewer::pointerReleased(const Vec2& at) {
    pointer_.release(screen(), pixels(at));
}

void Viewer::pointerDragged(const Vec2& by, const Vec2& at) {
    pointer_.drag(pixels(at));
    if (!pointer_.held() && !gui_.wantsPointer()) turn_ -= kRadiansPerPixel * by;
}

void Viewer::scrolled(float steps) {
    if (!gui_.wantsPointer()) walk_.changeSpeed(steps);
}

void Viewer::addBookmark() {
    walk_.addBookmark();
    remember();
}

void Viewer::captureMouse(bool on) {
    window_->capturePointer(on);
    say(on ? "mouse captured: Escape frees it" : "mouse free");
}

void Viewer::toggleFullscreen() {
    window_->setFullscreen(!window_->fullscreen());
    say(window_->fullscreen() ? "full screen" : "window");
}

void Viewer::saveBake() {
    if (live_)
        live_->save();
    else
        say("this room comes from a field file: there is nothing to save");
}

void Viewer::attempt(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& e) {
        announce(e.what());
    }
}

void Viewer::addObject(const std::string& text) {
    const Scene& scene = shownRoom_->room().scene;
    const Ray ahead = screen().ray(0.5f * pixels(Vec2(1)));
    const Vec3 place = objects_.placeAlong(ahead, suitableSize(scene));
    attempt([&] { objects_.add(parseObject(text, scene, options_.object, place)); });
}

void Viewer::saveObjects() {
    attempt([&] {
        const std::string name = writeNumberedFile(
            stemOf(options_.file), "json",
            [&](const std::string& file) { writeScenario(file, objects_.scenario()); });
        announce(name + " written");
    });
}

void Viewer::escape() {
    if (window_->pointerCaptured())
        captureMouse(false);
    else if (shown_.help)
        shown_.help = false;
    else
        window_->close();
}

void Viewer::say(const std::string& text) {
    message_ = text;
    messageAge_ = 0;
    if (!options_.verbose) return;
    fmt::print("{}\n", text);
    std::fflush(stdout);
}

/// What is also told on the terminal.
void Viewer::announce(const std::string& text) {
    say(text);
    if (!options_.quiet && !options_.verbose) fmt::print("{}\n", text);
}

void Viewer::reloadShaders(float seconds) {
    if (!due(sinceWatched_, seconds, kWatching) || !shaderWatch_.changed()) return;
    try {
        shownRoom_->reloadShaders();
        comparison_.reloadShaders();
        problem_.clear();
        say("shaders reloaded");
    } catch (const Error& e) {
        problem_ = e.what();
        say("shaders kept: the new ones are at fault");
    }
}

/// What cannot be shown of this room does not end the walk.
void Viewer::drawRoom(float seconds) {
    const gl::TimedPass pass(roomTimer_);
    if (comparison_.shown()) {
        try {
            return comparison_.draw(*shownRoom_, walk_.camera(), walk_.settings(),
                                    window_->pixelWidth(), window_->pixelHeight(),
                                    window_->pointer().x, seconds);
        } catch (const InputError& e) {
            comparison_.end();
            announce(e.what());
        }
    }
    const View view = viewOf(walk_.camera(), window_->pixelWidth(), window_->pixelHeight(),
                             shownRoom_->renderer().nearest());
    try {
        shownRoom_->draw(view, walk_.settings(), 0);
    } catch (const InputError& e) {
        if (walk_.mode() == 0) throw;
        walk_.setMode(0);
        announce(e.what());
        shownRoom_->draw(view, walk_.settings(), 0);
    }
}

void Viewer::adaptExposure(float seconds) {
    if (!walk_.exposure().automatic()) return;
    if (due(sinceMetered_, seconds, kMetering))
        meter_.measure(
            shownRoom_->renderer(), walk_.camera(),
            static_cast<float>(window_->pixelWidth()) / static_cast<float>(window_->pixelHeight()));
    if (const auto wanted = meter_.exposure()) walk_.exposure().adapt(*wanted, seconds);
}

void Viewer::drawMessages(float seconds) {
    messageAge_ += seconds;
    if (messageAge_ < kMessage) drawMessage(message_, (kMessage - messageAge_) / kFade);
    const std::string problem = problem_.empty() && live_ ? live_->problem() : problem_;
    if (!problem.empty()) drawProblem(problem);
    if (const std::string line = status(); !line.empty()) drawStatus(line);
}

/// What is under way, in a line.
std::string Viewer::status() const {
    std::string line = live_ ? live_->activity() : std::string();
    if (line.empty()) line = comparison_.status();
    const std::optional<double> refined = shownRoom_->refined();
    if (line.empty() && refined && *refined < 1)
        line = fmt::format("refining {:.0f} %", 100 * *refined);
    return line;
}

void Viewer::drawObjectGizmo() {
    const Screen seen = screen();
    const std::optional<Gizmo> gizmo = pointer_.gizmo(seen, window_->contentScale());
    if (!gizmo) return;
    const GizmoHandle bright =
        pointer_.held() ? pointer_.held() : gizmo->pick(pixels(window_->pointer()));
    drawGizmo(seen, static_cast<float>(window_->pixelWidth()), *gizmo, bright);
}

void Viewer::drawOverlays() {
    if (comparison_.shown())
        comparison_.drawOverlay();
    else
        drawObjectGizmo();
    if (shown_.help)
        drawHelp();
    else if (shown_.panel)
        drawPanel(*this);
    if (shown_.statistics && !shown_.help)
        drawStatistics(statistics_,
                       {{"CPU objects", objectsMs_},
                        {"GPU room", roomTimer_.milliseconds()},
                        {"GPU overlay", overlayTimer_.milliseconds()}},
                       shownRoom_->renderer().memory());
    const gl::TimedPass pass(overlayTimer_);
    gui_.draw();
}

/// A picture that cannot be written does not end the walk.
void Viewer::writeWantedPicture() {
    const auto kind = std::exchange(pictureWanted_, std::nullopt);
    if (!kind) return;
    try {
        const std::string name = writePicture(*kind);
        announce(name + " written");
    } catch (const Error& e) {
        say(e.what());
        printWarning(options_.quiet, e.what());
    }
}

/// As it is shown, without what lies over it, or its radiance. Returns the name of the file.
std::string Viewer::writePicture(Picture kind) {
    const int width = window_->pixelWidth(), height = window_->pixelHeight();
    if (kind == Picture::png)
        return writeNumberedFile(stemOf(options_.file), "png", [&](const std::string& name) {
            writePng(name, readFramebuffer(0, width, height));
        });
    StillParams params;
    params.camera = walk_.camera();
    params.width = width;
    params.height = height;
    const DisplayMode mode = shownRoom_->drawable(walk_.settings().mode);
    params.mode = mode == DisplayMode::field ? mode : DisplayMode::raytraced;
    params.lookup = walk_.lookup();
    return writeNumberedFile(stemOf(options_.file), "exr", [&](const std::string& name) {
        Progress progress;
        writeExr(name, renderStill(shownRoom_->renderer(), params, progress));
    });
}

void Viewer::showTitle(float seconds) {
    if (due(sinceTitle_, seconds, kTitle))
        window_->setTitle(fmt::format("{} - {:.0f} fps", options_.file, statistics_.rate()));
}

}  // namespace vlf::app
