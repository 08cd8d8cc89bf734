// vlf view: a window to walk through a room, baked or while it is being baked.

#include "bake_options.h"
#include "camera_options.h"
#include "commands.h"
#include "console.h"
#include "environment_options.h"
#include "gpu_options.h"
#include "number_within.h"
#include "object_options.h"
#include "picture_output.h"
#include "viewer/display_modes.h"
#include "viewer/key_bindings.h"
#include "viewer/viewer.h"

#include "vlf/base/error.h"
#include "vlf/display/preferences.h"
#include "vlf/io/field_file.h"
#include "vlf/live/live_bake.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vlf::app {

namespace {

struct Options {
    std::vector<std::string> files;
    EnvironmentOptions environment;
    QualityOptions quality;
    CameraOptions camera;
    ObjectOptions objects;
    ViewerOptions viewer;
    std::string replay;  ///< file of a path to follow; empty: none
    std::string mode;
    bool fresh = false;
    bool noVsync = false;
    std::uint64_t frames = 0;  ///< 0: until the window is closed
};

std::vector<std::string> modeNames() {
    std::vector<std::string> names;
    for (const ViewMode& mode : kViewModes) names.push_back(mode.name);
    return names;
}

std::size_t modeOf(const std::string& name) {
    const std::vector<std::string> names = modeNames();
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

bool isField(const std::string& file) {
    return std::filesystem::path(file).extension() == ".vlf";
}

ViewerOptions viewerOptions(const Options& options, const Globals& globals, const Scene& scene) {
    ViewerOptions viewer = options.viewer;
    viewer.file = options.files.front();
    viewer.start = chooseCamera(options.camera, scene.cameras, defaultCamera(scene));
    viewer.window.place.width = options.camera.width;
    viewer.window.place.height = options.camera.height;
    viewer.window.vsync = !options.noVsync;
    viewer.mode = modeOf(options.mode);
    if (!options.fresh) viewer.preferences = preferencesPath();
    viewer.quiet = globals.quiet;
    viewer.verbose = globals.verbose;
    viewer.objects = readObjects(options.objects, scene, viewer.models, globals);
    viewer.object = options.objects.defaults;
    if (options.replay.empty()) return viewer;
    Walk walk = readWalk(options.replay, options.objects, viewer.models, globals);
    viewer.session.replay = std::move(walk.camera);
    if (!walk.objects.objects.empty()) viewer.objects = std::move(walk.objects);
    return viewer;
}

void walk(Viewer& viewer, std::uint64_t frames) {
    using Clock = std::chrono::steady_clock;
    const ConsoleProgress interrupt(true);
    Clock::time_point last = Clock::now();
    try {
        for (std::uint64_t i = 0; !viewer.closing() && (frames == 0 || i < frames); ++i) {
            if (interrupt.cancelled()) break;
            const Clock::time_point now = Clock::now();
            viewer.frame(std::chrono::duration<double>(now - std::exchange(last, now)).count());
        }
    } catch (...) {
        viewer.finish();  // what was recorded is not lost
        throw;
    }
    viewer.finish();
}

void open(std::shared_ptr<const BakedRoom> room, const ViewerOptions& options,
          std::uint64_t frames) {
    Viewer viewer(std::move(room), options);
    if (!options.quiet) {
        fmt::print("H in the window shows the keys\n");
        std::fflush(stdout);
    }
    walk(viewer, frames);
}

/// Waits for the first state of a live bake that can be shown. Throws InputError if its files
/// cannot be read, and Cancelled.
LiveUpdate firstRoom(LiveBake& bake, const Globals& globals) {
    ConsoleProgress progress(globals.quiet);
    std::string activity;
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
        progress.check();
        const std::optional<LiveUpdate> update = bake.poll();
        if (update && update->room) return *update;
        const LiveStatus status = bake.status();
        if (!status.error.empty()) throw InputError(status.error);
        if (status.activity != activity) progress.stage(activity = status.activity);
        progress.update(status.fraction);
    }
}

void viewScene(const Options& options, const Globals& globals) {
    requireWritableOutputs({options.viewer.output});
    LiveOptions live;
    live.programVersion = VLF_VERSION;
    live.environment = environmentOf(options.environment);
    LiveBake bake(options.files, bakeParams(options.quality, globals), live);
    const LiveUpdate first = firstRoom(bake, globals);
    for (const std::string& warning : bake.status().warnings) printWarning(globals.quiet, warning);
    ViewerOptions viewer = viewerOptions(options, globals, first.room->scene);
    viewer.live = &bake;
    viewer.light = first.irradiance;
    open(first.room, viewer, options.frames);
}

void viewField(const Options& options, const Globals& globals) {
    const auto room = std::make_shared<const BakedRoom>(readField(options.files.front()));
    open(room, viewerOptions(options, globals, room->scene), options.frames);
}

void run(const Options& options, const Globals& globals, bool asksForBake) {
    requireWritableOutputs({options.viewer.session.record, options.viewer.session.log});
    if (std::none_of(options.files.begin(), options.files.end(), isField))
        return viewScene(options, globals);
    if (options.files.size() > 1)
        throw CLI::ValidationError("FILE", "takes one field file, or any number of scene files");
    if (asksForBake)
        throw CLI::ValidationError("FILE", options.files.front() +
                                               " is baked already: -o, --environment and the "
                                               "options of quality are for scene files");
    viewField(options, globals);
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
        .add_option("--shaders", options.viewer.renderer.shaderFolder,
                    "Folder of shaders to use in place of the built-in ones; loaded anew whenever "
                    "they change")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR");
}

void addSessionOptions(CLI::App& command, SessionOptions& session, std::string& path) {
    CLI::Option_group* group = command.add_option_group("Session", "Writing down and replaying");
    group->add_option("--record", session.record, "Write the path of camera and objects (.json)")
        ->type_name("PATH");
    CLI::Option* replay = group->add_option("--replay", path, "Follow such a path")
                              ->check(CLI::ExistingFile)
                              ->type_name("PATH");
    group->add_flag("--loop", session.loop, "Begin the replay again when it ends")->needs(replay);
    group
        ->add_option("--fps", session.fps,
                     "Frames a second of the session's own time, whatever they take: replays are "
                     "then equal, frame by frame")
        ->check(numberWithin(1, 1000))
        ->type_name("N");
    group->add_option("--log", session.log, "Write every frame's times and pose (.csv or .json)")
        ->check(frameLogNameProblem, "log name")
        ->type_name("LOG");
}

}  // namespace

void addView(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<Options>();
    options->camera.width = 1024;
    options->camera.height = 768;
    options->viewer.window.samples = 4;
    options->mode = kViewModes.front().name;
    CLI::App* command = app.add_subcommand("view", "Walk through a room in a window");
    command
        ->add_option("files", options->files,
                     "A field file (.vlf), or scene files, which are baked meanwhile")
        ->required()
        ->type_name("FILE...");
    addCameraOptions(*command, options->camera);
    addObjectOptions(*command, options->objects);
    addWindowOptions(*command, *options);
    addGpuOptions(*command, options->viewer.renderer);
    command->add_option("--mode", options->mode, "What to show first; M shows the next")
        ->check(CLI::IsMember(modeNames()))
        ->capture_default_str();
    addSessionOptions(*command, options->viewer.session, options->replay);
    const CLI::Option* output =
        command
            ->add_option("-o,--output", options->viewer.output,
                         "Of scene files: write the finished bake (.vlf); F5 saves it as it is")
            ->type_name("FIELD");
    const CLI::Option* environment = addEnvironmentOptions(*command, options->environment);
    const CLI::Option_group* quality = addQualityOptions(*command, options->quality);
    command->footer(objectHelp() + "\nKeys:\n" + keyHelp() +
                    "\nPlace, speed, bookmarks and the window are remembered; see --fresh. Of "
                    "scene files,\nchanges on disk are baked anew.\n\n"
                    "Examples:\n"
                    "  vlf view room.vlf\n"
                    "  vlf view room.vlf --camera front --size 1280x960\n"
                    "  vlf view room.obj -o room.vlf\n"
                    "  vlf view house.obj --environment sky.hdr\n"
                    "  vlf view room.vlf --object cube:0.3:red --object sphere:mirror\n"
                    "  vlf view room.vlf --record walk.json\n"
                    "  vlf view room.vlf --replay walk.json --fps 30 --log frames.csv");
    command->callback([options, command, output, environment, quality, &globals] {
        for (const char* chosen : {"--camera", "--eye", "--up", "--fov"})
            options->viewer.startChosen |= command->count(chosen) > 0;
        options->viewer.samplesChosen = command->count("--samples") > 0;
        options->viewer.placeChosen = command->count("--size") > 0;
        run(*options, globals,
            output->count() > 0 || environment->count() > 0 || quality->count_all() > 0);
    });
}

}  // namespace vlf::app
