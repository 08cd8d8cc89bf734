// vlf view: a window to walk through a baked room.

#include "camera_options.h"
#include "commands.h"
#include "console.h"
#include "gpu_options.h"

#include "vlf/base/error.h"
#include "vlf/display/camera_pose.h"
#include "vlf/image/image_io.h"
#include "vlf/io/field_file.h"
#include "vlf/render/gl/read_framebuffer.h"
#include "vlf/render/gl/renderer.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace vlf::app {

namespace {

constexpr float kRadiansPerPixel = 0.003f;
constexpr float kSecondsAcross = 6;     // to cross the room's bounding sphere
constexpr float kExposureStep = 0.25f;  // EV
constexpr const char* kPicture = "vlf-view.png";

constexpr const char* kKeys =
    "W A S D, arrows  go; Q, E: down, up; Shift: faster\n"
    "mouse            look around while a button is held\n"
    "1 ... 9          cameras of the scene\n"
    "+ -              exposure;  0: back to the start\n"
    "L                mirrors: correct the lookup by depth, or not\n"
    "F12              write the picture to vlf-view.png\n"
    "Escape           close";

struct Options {
    std::string field;
    CameraOptions camera;
    RendererOptions gpu;
};

/// GLFW as long as it is needed. Throws Error with what GLFW says.
class Window {
  public:
    Window(int width, int height, const std::string& title) {
        if (!glfwInit()) fail("cannot open a display");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_DEPTH_BITS, 24);
        window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
        if (!window_) fail("cannot open a window with OpenGL 4.5");
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
    }
    ~Window() { glfwTerminate(); }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }

  private:
    [[noreturn]] static void fail(const std::string& what) {
        const char* reason = nullptr;
        glfwGetError(&reason);
        const std::string text = reason ? reason : "no reason given";
        glfwTerminate();
        throw Error(what + ": " + text + "; vlf render makes pictures without a window");
    }

    GLFWwindow* window_ = nullptr;
};

/// The walk: what keys and mouse have made of camera and settings.
class Walk {
  public:
    Walk(const Window& window, const BakedRoom& room, const Camera& start)
        : window_(window.handle()), room_(room), start_(start), pose_(poseOf(start)) {
        resetExposure();
        glfwSetWindowUserPointer(window_, this);
        glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int) {
            if (action != GLFW_RELEASE) static_cast<Walk*>(glfwGetWindowUserPointer(w))->press(key);
        });
        glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
            static_cast<Walk*>(glfwGetWindowUserPointer(w))->point({x, y});
        });
    }

    void advance(float seconds) {
        const auto held = [&](int key, int other = GLFW_KEY_UNKNOWN) {
            return glfwGetKey(window_, key) == GLFW_PRESS ||
                   (other != GLFW_KEY_UNKNOWN && glfwGetKey(window_, other) == GLFW_PRESS);
        };
        const auto axis = [](bool plus, bool minus) {
            return static_cast<float>(plus) - static_cast<float>(minus);
        };
        const Vec3 way(axis(held(GLFW_KEY_D, GLFW_KEY_RIGHT), held(GLFW_KEY_A, GLFW_KEY_LEFT)),
                       axis(held(GLFW_KEY_E), held(GLFW_KEY_Q)),
                       axis(held(GLFW_KEY_W, GLFW_KEY_UP), held(GLFW_KEY_S, GLFW_KEY_DOWN)));
        const float speed = 2 * room_.field.frame.radius / kSecondsAcross;
        const bool fast = held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
        const Vec3 metres = way * (seconds * speed * (fast ? 3.0f : 1.0f));
        pose_.eye += metres.x * pose_.right() + Vec3(0, metres.y, 0) + metres.z * pose_.forward();
    }

    Camera camera() const { return cameraOf(pose_); }
    const RenderSettings& settings() const { return settings_; }
    bool takePictureWanted() { return std::exchange(pictureWanted_, false); }

  private:
    void press(int key) {
        const auto number = static_cast<std::size_t>(key - GLFW_KEY_1);
        if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9 && number < room_.scene.cameras.size())
            pose_ = poseOf(room_.scene.cameras[number]);
        if (key == GLFW_KEY_0) {
            pose_ = poseOf(start_);
            resetExposure();
        }
        if (key == GLFW_KEY_EQUAL || key == GLFW_KEY_KP_ADD) settings_.exposure += kExposureStep;
        if (key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_SUBTRACT)
            settings_.exposure -= kExposureStep;
        if (key == GLFW_KEY_L)
            settings_.lookup = settings_.lookup == LookupKind::plain ? LookupKind::depthCorrected
                                                                     : LookupKind::plain;
        if (key == GLFW_KEY_F12) pictureWanted_ = true;
        if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window_, GLFW_TRUE);
    }

    void point(const Vec2& at) {
        bool held = false;
        for (const int button : {GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT})
            held = held || glfwGetMouseButton(window_, button) == GLFW_PRESS;
        const Vec2 turn = kRadiansPerPixel * (at - pointer_);
        if (held) {
            pose_.yaw -= turn.x;
            pose_.pitch =
                std::clamp(pose_.pitch - turn.y, -CameraPose::kMostPitch, CameraPose::kMostPitch);
        }
        pointer_ = at;
    }

    void resetExposure() {
        // As if all walls were grey, of reflectance 1/2.
        const IrradianceAtlas& atlas = room_.field.atlas;
        Image walls(static_cast<int>(atlas.width), static_cast<int>(atlas.height));
        for (std::size_t i = 0; i < walls.pixels.size(); ++i)
            walls.pixels[i] = atlas.irradiance[i] / (2 * kPi);
        settings_.exposure = autoExposure(walls);
    }

    GLFWwindow* window_;
    const BakedRoom& room_;
    Camera start_;
    CameraPose pose_;
    RenderSettings settings_;
    Vec2 pointer_{0};
    bool pictureWanted_ = false;
};

/// Frames a second over the last half second, in the title.
class TitleClock {
  public:
    using Clock = std::chrono::steady_clock;

    /// Seconds since the last call.
    float tick(GLFWwindow* window, const std::string& name) {
        const Clock::time_point now = Clock::now();
        const float seconds = std::chrono::duration<float>(now - std::exchange(last_, now)).count();
        ++frames_;
        if (const float since = std::chrono::duration<float>(now - shown_).count(); since > 0.5f) {
            const auto rate = static_cast<float>(frames_) / since;
            glfwSetWindowTitle(window, fmt::format("{} - {:.0f} fps", name, rate).c_str());
            frames_ = 0;
            shown_ = now;
        }
        return seconds;
    }

  private:
    Clock::time_point last_ = Clock::now(), shown_ = last_;
    int frames_ = 0;
};

/// A picture that cannot be written does not end the walk.
void writePicture(const Image& picture, const Globals& globals) {
    try {
        writePng(kPicture, picture);
        if (!globals.quiet) fmt::print("{} written\n", kPicture);
    } catch (const FileError& e) {
        printWarning(globals.quiet, e.what());
    }
}

void run(const Options& options, const Globals& globals) {
    const BakedRoom room = readField(options.field);
    const Camera start =
        chooseCamera(options.camera, room.scene.cameras, defaultCamera(room.scene));
    const Window window(options.camera.width, options.camera.height, options.field);
    Renderer renderer(room.scene, room.field, options.gpu);
    printNotices(globals.quiet, renderer);
    Walk walk(window, room, start);
    if (!globals.quiet) fmt::print("{}\n", kKeys);
    TitleClock clock;
    while (!glfwWindowShouldClose(window.handle())) {
        glfwPollEvents();
        walk.advance(clock.tick(window.handle(), options.field));
        int width = 0, height = 0;
        glfwGetFramebufferSize(window.handle(), &width, &height);
        if (width == 0 || height == 0) {  // minimised
            glfwWaitEventsTimeout(0.1);
            continue;
        }
        renderer.draw(viewOf(walk.camera(), width, height, renderer.nearest()), walk.settings(), 0);
        if (walk.takePictureWanted()) writePicture(readFramebuffer(0, width, height), globals);
        glfwSwapBuffers(window.handle());
    }
}

}  // namespace

void addView(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<Options>();
    options->camera.width = 1024;
    options->camera.height = 768;
    CLI::App* command = app.add_subcommand("view", "Walk through a baked room in a window");
    command->add_option("field", options->field, "Field file (.vlf)")
        ->required()
        ->type_name("FIELD");
    addCameraOptions(*command, options->camera);
    addGpuOptions(*command, options->gpu);
    command->footer(std::string("Keys:\n") + kKeys +
                    "\n\nExamples:\n"
                    "  vlf view room.vlf\n"
                    "  vlf view room.vlf --camera front --size 1280x960");
    command->callback([options, &globals] { run(*options, globals); });
}

}  // namespace vlf::app
