// vlf render: stills of a baked room, and films of a walk through it.

#include "commands.h"
#include "console.h"
#include "eye_pictures.h"
#include "film.h"

#include "vlf/base/error.h"

#include <cctype>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

struct Still {
    Camera camera;
    std::string path;
    StillReport report;
};

/// The name of a camera with what is no plain part of a file name replaced.
std::string fileStem(const Camera& camera) {
    std::string stem = camera.name.empty() ? "camera" : camera.name;
    for (char& c : stem)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
    return stem;
}

/// Every camera, its picture named by the pattern with the camera's name for the last '%'.
std::vector<Still> stillOfEachCamera(const std::string& pattern, std::vector<Camera> cameras,
                                     const Camera& fallback) {
    if (cameras.empty()) cameras.push_back(fallback);
    const std::size_t place = pattern.rfind('%');
    std::set<std::string> used;
    std::vector<Still> stills;
    for (const Camera& camera : cameras) {
        std::string stem = fileStem(camera);
        while (!used.insert(stem).second) stem += "_";
        stills.push_back({camera, pattern.substr(0, place) + stem + pattern.substr(place + 1), {}});
    }
    return stills;
}

std::vector<Still> stillsToRender(const RenderOptions& options, const Scene& scene) {
    const Camera fallback = defaultCamera(scene);
    if (options.allCameras) return stillOfEachCamera(options.picture.path, scene.cameras, fallback);
    return {{chooseCamera(options.camera, scene.cameras, fallback), options.picture.path, {}}};
}

void renderStills(const RenderOptions& options, const Globals& globals, RoomRenderer& renderer,
                  std::vector<Still>& stills) {
    const PictureOptions picture = pictureOptions(options);
    const StereoLayout layout = options.stereo.layout;
    for (Still& still : stills) {
        ConsoleProgress progress(globals.quiet);
        std::vector<Image> eyes = renderEyes(renderer, stillParams(options, still.camera),
                                             options.stereo, progress, still.report);
        const float exposure = exposureOf(picture, eyes);
        const std::vector<Image> pictures = develop(picture, exposure, layout, std::move(eyes));
        const std::vector<std::string> files = eyeFiles(layout, still.path);
        for (std::size_t i = 0; i < files.size(); ++i)
            writeFinished(files[i], pictures[i],
                          {{"vlf.mode", nameOf(kModeNames, options.still.mode)},
                           {"vlf.camera", still.camera.name}});
        if (!globals.quiet)
            fmt::print("{}: {}x{} pixels, {:.2f} million rays in {:.2f} s\n",
                       fmt::join(files, ", "), pictures[0].width, pictures[0].height,
                       1e-6 * static_cast<double>(still.report.rays), still.report.seconds);
    }
}

nlohmann::ordered_json toJson(const Still& still) {
    return {{"camera",
             {{"name", still.camera.name},
              {"eye", numbers(still.camera.eye)},
              {"look", numbers(still.camera.look)},
              {"up", numbers(still.camera.up)},
              {"verticalFov", still.camera.verticalFov}}},
            {"seconds", still.report.seconds},
            {"rays", still.report.rays},
            {"output", still.path}};
}

nlohmann::ordered_json toJson(const std::vector<Still>& stills) {
    nlohmann::ordered_json pictures = nlohmann::ordered_json::array();
    for (const Still& still : stills) pictures.push_back(toJson(still));
    return pictures;
}

nlohmann::ordered_json toJson(const GpuMemory& memory) {
    return {{"geometry", memory.geometry},
            {"atlas", memory.atlas},
            {"radiance", memory.radiance},
            {"textures", memory.textures},
            {"hits", memory.hits},
            {"drawings", memory.drawings},
            {"objects", memory.objects},
            {"radianceElements", memory.radianceElements}};
}

nlohmann::ordered_json toJson(const RenderOptions& options) {
    nlohmann::ordered_json report{{"field", options.field},
                                  {"mode", nameOf(kModeNames, options.still.mode)},
                                  {"backend", nameOf(kBackendNames, options.backend)},
                                  {"lookup", nameOf(kLookupNames, options.still.lookup)},
                                  {"antialias", options.still.antialias},
                                  {"width", options.camera.width},
                                  {"height", options.camera.height}};
    if (options.stereo.layout == StereoLayout::none) return report;
    const EyePair& eyes = options.stereo.eyes;
    report["stereo"] = {{"layout", nameOf(kStereoNames, options.stereo.layout)},
                        {"eyeSeparation", eyes.separation}};
    if (eyes.convergence) report["stereo"]["convergence"] = *eyes.convergence;
    return report;
}

void run(const CLI::App& command, const RenderOptions& options, const Globals& globals) {
    requireConsistent(command, options);
    requireWritableOutputs({options.json});
    if (!options.film.moves()) requireWritableOutputs({options.picture.path});
    const BakedRoom room = readField(options.field);
    RoomRenderer renderer(options, room, globals);
    nlohmann::ordered_json report = toJson(options);
    if (options.film.moves()) {
        report["film"] = renderFilm(options, globals, renderer, room.scene.cameras);
    } else {
        std::vector<Still> stills = stillsToRender(options, room.scene);
        renderStills(options, globals, renderer, stills);
        report["pictures"] = toJson(stills);
    }
    if (const auto memory = renderer.gpuMemory()) report["gpuMemory"] = toJson(*memory);
    if (!options.json.empty()) writeJson(options.json, report);
}

}  // namespace

void addRender(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render stills or a film of a baked room");
    addRenderOptions(*command, *options);
    command->footer(
        std::string(
            "Modes:\n"
            "  raytraced    diffuse light from the field, mirrors by tracing reflections,\n"
            "               those of rough mirrors with --backend cpu\n"
            "  field        diffuse light and mirrors from the field, no reflection traced\n"
            "  progressive  what that mode of a window comes to at rest: as raytraced\n"
            "  wireframe    a line drawing; hidden edges faint\n"
            "  diagram      the structure of the field (--diagram)\n"
            "--exposure and --tone have no effect on drawings.\n\n"
            "Stereo:\n"
            "  side-by-side  both pictures in one, twice as wide\n"
            "  anaglyph      one picture for red-cyan glasses\n"
            "  pair          two files, NAME-left and NAME-right\n\n"
            "Films:\n"
            "  --path or --tour moves the camera; --film or pictures as -o NAME-%05d.png show "
            "it.\n\n") +
        objectHelp() +
        "A film shows the scenario from its beginning, stills its --moment.\n\n"
        "Examples:\n"
        "  vlf render room.vlf --camera front --size 1024x768 -o front.png\n"
        "  vlf render room.vlf --all-cameras -o stills/%.png\n"
        "  vlf render room.vlf --object cube:0.1:red@1,0.05,2 -o cube.png\n"
        "  vlf render room.vlf --mode diagram --diagram tile -o tile.png\n"
        "  vlf render room.vlf --camera front --stereo anaglyph --convergence 2 -o front.png\n"
        "  vlf render room.vlf --tour --backend gl --mode field --film tour.mp4\n"
        "  vlf render room.vlf --path walk.json --from 2 --to 4.5 -o frames/room-%05d.exr");
    command->callback([command, options, &globals] { run(*command, *options, globals); });
}

}  // namespace vlf::app
