// vlf view: a window to walk through a baked room.

#include "camera_options.h"
#include "commands.h"
#include "viewer/key_bindings.h"
#include "viewer/viewer.h"

#include "vlf/display/preferences.h"
#include "vlf/io/field_file.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace vlf::app {

namespace {

struct Options {
    CameraOptions camera;
    ViewerOptions viewer;
    bool fresh = false;
    bool noVsync = false;
    std::uint64_t frames = 0;  ///< 0: until the window is closed
};

ViewerOptions viewerOptions(const Options& options, const Globals& globals, const Scene& scene) {
    ViewerOptions viewer = options.viewer;
    viewer.start = chooseCamera(options.camera, scene.cameras, defaultCamera(scene));
    viewer.window.place.width = options.camera.width;
    viewer.window.place.height = options.camera.height;
    viewer.window.vsync = !options.noVsync;
    if (!options.fresh) viewer.preferences = preferencesPath();
    viewer.quiet = globals.quiet;
    viewer.verbose = globals.verbose;
    return viewer;
}

void walk(Viewer& viewer, std::uint64_t frames) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    for (std::uint64_t i = 0; !viewer.closing() && (frames == 0 || i < frames); ++i) {
        const Clock::time_point now = Clock::now();
        viewer.frame(std::chrono::duration<double>(now - std::exchange(last, now)).count());
    }
}

void run(const Options& options, const Globals& globals) {
    const BakedRoom room = readField(options.viewer.field);
    Viewer viewer(room, viewerOptions(options, globals, room.scene));
    if (!globals.quiet) {
        fmt::print("H in the window shows the keys\n");
        std::fflush(stdout);
    }
    walk(viewer, options.frames);
    viewer.remember();
}

void addWindowOptions(CLI::App& command, Options& options) {
    command.add_flag("--fullscreen", options.viewer.window.fullscreen, "Fill the screen");
    command
        .add_option("--samples", options.viewer.window.samples,
                    "Samples per pixel, for smooth edges; 0: none")
        ->check(CLI::Range(0, 16))
        ->option_text("N [4, or 0 where the CPU draws]");
    command.add_flag("--no-vsync", options.noVsync, "Draw as fast as possible");
    command.add_option("--frames", options.frames, "Close after N frames")->type_name("N");
    command.add_flag("--fresh", options.fresh, "Neither use nor change what is remembered");
    command
        .add_option("--shaders", options.viewer.shaderFolder,
                    "Folder of shaders to use in place of the built-in ones; loaded anew whenever "
                    "they change")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR");
}

}  // namespace

void addView(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<Options>();
    options->camera.width = 1024;
    options->camera.height = 768;
    options->viewer.window.samples = 4;
    CLI::App* command = app.add_subcommand("view", "Walk through a baked room in a window");
    command->add_option("field", options->viewer.field, "Field file (.vlf)")
        ->required()
        ->type_name("FIELD");
    addCameraOptions(*command, options->camera);
    addWindowOptions(*command, *options);
    command->footer("Keys:\n" + keyHelp() +
                    "\nPlace, speed, bookmarks and the window are remembered; see --fresh.\n\n"
                    "Examples:\n"
                    "  vlf view room.vlf\n"
                    "  vlf view room.vlf --camera front --size 1280x960");
    command->callback([options, command, &globals] {
        for (const char* chosen : {"--camera", "--eye", "--up", "--fov"})
            options->viewer.startChosen |= command->count(chosen) > 0;
        options->viewer.samplesChosen = command->count("--samples") > 0;
        options->viewer.placeChosen = command->count("--size") > 0;
        run(*options, globals);
    });
}

}  // namespace vlf::app
