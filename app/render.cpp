// vlf render: stills of a baked room.

#include "camera_options.h"
#include "commands.h"
#include "console.h"
#include "gpu_options.h"
#include "picture_output.h"

#include "vlf/base/error.h"
#include "vlf/io/field_file.h"
#include "vlf/render/cpu/still.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/still.h"

#include <cctype>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

enum class Backend { cpu, gl };

struct Options {
    std::string field;
    Backend backend = Backend::cpu;
    RendererOptions gpu;
    CameraOptions camera;
    PictureOptions picture;
    std::string json;
    bool allCameras = false;
    std::vector<std::uint32_t> tile;
    StillParams still;
};

const std::map<std::string, DisplayMode> kModeNames{{"raytraced", DisplayMode::raytraced},
                                                    {"field", DisplayMode::field},
                                                    {"wireframe", DisplayMode::wireframe},
                                                    {"diagram", DisplayMode::diagram}};
const std::map<std::string, Backend> kBackendNames{{"cpu", Backend::cpu}, {"gl", Backend::gl}};
const std::map<std::string, LookupKind> kLookupNames{{"depth", LookupKind::depthCorrected},
                                                     {"plain", LookupKind::plain}};
const std::map<std::string, DiagramKind> kDiagramNames{{"directions", DiagramKind::directions},
                                                       {"subfield", DiagramKind::subfield},
                                                       {"tile", DiagramKind::tile},
                                                       {"chart", DiagramKind::chart}};

template <typename Value>
std::string nameOf(const std::map<std::string, Value>& names, Value value) {
    for (const auto& [name, candidate] : names)
        if (candidate == value) return name;
    return {};
}

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

std::vector<Still> stillsToRender(const Options& options, const Scene& scene) {
    const Camera fallback = defaultCamera(scene);
    if (options.allCameras) return stillOfEachCamera(options.picture.path, scene.cameras, fallback);
    return {{chooseCamera(options.camera, scene.cameras, fallback), options.picture.path, {}}};
}

StillParams stillParams(const Options& options, const Camera& camera) {
    StillParams params = options.still;
    params.camera = camera;
    params.width = options.camera.width;
    params.height = options.camera.height;
    if (!options.tile.empty()) {
        params.diagram.tileX = options.tile[0];
        params.diagram.tileY = options.tile[1];
    }
    return params;
}

/// Drawings are display colours already.
PictureOptions pictureOptions(const Options& options, const std::string& path) {
    PictureOptions picture = options.picture;
    picture.path = path;
    if (!showsRadiance(options.still.mode)) {
        picture.exposure = "0";
        picture.tone = ToneCurve::clamp;
    }
    return picture;
}

std::vector<float> numbers(const Vec3& v) {
    return {v.x, v.y, v.z};
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

nlohmann::ordered_json toJson(const GpuMemory& memory) {
    return {{"geometry", memory.geometry},
            {"atlas", memory.atlas},
            {"radiance", memory.radiance},
            {"textures", memory.textures},
            {"radianceElements", memory.radianceElements}};
}

nlohmann::ordered_json toJson(const Options& options, const std::vector<Still>& stills,
                              const std::optional<GpuMemory>& memory) {
    nlohmann::ordered_json pictures = nlohmann::ordered_json::array();
    for (const Still& still : stills) pictures.push_back(toJson(still));
    nlohmann::ordered_json report{{"field", options.field},
                                  {"mode", nameOf(kModeNames, options.still.mode)},
                                  {"backend", nameOf(kBackendNames, options.backend)},
                                  {"lookup", nameOf(kLookupNames, options.still.lookup)},
                                  {"antialias", options.still.antialias},
                                  {"width", options.camera.width},
                                  {"height", options.camera.height},
                                  {"pictures", pictures}};
    if (memory) report["gpuMemory"] = toJson(*memory);
    return report;
}

using StillRenderer = std::function<Image(const StillParams&, Progress&, StillReport&)>;

void renderAll(const Options& options, const Globals& globals, const StillRenderer& render,
               std::vector<Still>& stills) {
    for (Still& still : stills) {
        ConsoleProgress progress(globals.quiet);
        const Image image = render(stillParams(options, still.camera), progress, still.report);
        writePicture(pictureOptions(options, still.path), image,
                     {{"vlf.mode", nameOf(kModeNames, options.still.mode)},
                      {"vlf.camera", still.camera.name}});
    }
}

void renderByCpu(const Options& options, const Globals& globals, const BakedRoom& room,
                 std::vector<Still>& stills) {
    const RayScene rays(room.scene);
    const auto render = [&](const StillParams& params, Progress& progress, StillReport& report) {
        return renderStill(room.scene, rays, room.field, params, progress, &report);
    };
    renderAll(options, globals, render, stills);
}

/// Returns what the room takes in the memory of the GPU.
GpuMemory renderByOpenGl(const Options& options, const Globals& globals, const BakedRoom& room,
                         std::vector<Still>& stills) {
    const gl::HeadlessContext context;
    Renderer renderer(room.scene, room.field, options.gpu);
    printNotices(globals.quiet, renderer);
    const auto render = [&](const StillParams& params, Progress& progress, StillReport& report) {
        return renderStill(renderer, params, progress, &report);
    };
    renderAll(options, globals, render, stills);
    return renderer.memory();
}

void run(const Options& options, const Globals& globals) {
    if (options.allCameras && options.picture.path.find('%') == std::string::npos)
        throw CLI::ValidationError("-o", "needs a % for the cameras' names with --all-cameras");
    requireWritableOutputs({options.picture.path, options.json});
    const BakedRoom room = readField(options.field);
    std::vector<Still> stills = stillsToRender(options, room.scene);
    std::optional<GpuMemory> memory;
    if (options.backend == Backend::gl)
        memory = renderByOpenGl(options, globals, room, stills);
    else
        renderByCpu(options, globals, room, stills);
    if (!options.json.empty()) writeJson(options.json, toJson(options, stills, memory));
    if (globals.quiet) return;
    for (const Still& still : stills)
        fmt::print("{}: {}x{} pixels, {:.2f} million rays in {:.2f} s\n", still.path,
                   options.camera.width, options.camera.height, 1e-6 * still.report.rays,
                   still.report.seconds);
}

void addModeOptions(CLI::App& command, StillParams& still) {
    command.add_option("--mode", still.mode, "What to show; see below")
        ->transform(CLI::CheckedTransformer(kModeNames))
        ->option_text("raytraced|field|wireframe|diagram [raytraced]");
    command
        .add_option("--lookup", still.lookup,
                    "Mode field: correct the lookup by the depth of what is seen, or not")
        ->transform(CLI::CheckedTransformer(kLookupNames))
        ->option_text("depth|plain [depth]");
    command
        .add_option("--antialias", still.antialias,
                    "Up to N x N rays per pixel, as many where the picture has detail")
        ->check(CLI::Range(1, 16))
        ->type_name("N")
        ->capture_default_str();
    command.add_flag("--normals", still.normals, "Mode wireframe: draw shading normals");
}

void addDiagramOptions(CLI::App& command, Options& options) {
    DiagramParams& diagram = options.still.diagram;
    command.add_option("--diagram", diagram.kind, "Mode diagram: what to draw")
        ->transform(CLI::CheckedTransformer(kDiagramNames))
        ->option_text("directions|subfield|tile|chart [directions]");
    command.add_option("--direction", diagram.direction,
                       "Diagram subfield or tile: number of the oriented direction");
    command.add_option("--tile", options.tile, "Diagram subfield or tile: column and row")
        ->delimiter(',')
        ->expected(2)
        ->type_name("X,Y");
    command.add_option("--chart", diagram.chart,
                       "Diagram chart: its number (else the one in the middle of the picture)");
}

}  // namespace

void addRender(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("render", "Render a still of a baked room");
    command->add_option("field", options->field, "Field file (.vlf)")
        ->required()
        ->type_name("FIELD");
    addCameraOptions(*command, options->camera);
    command
        ->add_flag("--all-cameras", options->allCameras,
                   "A picture from every camera, its name in place of % in -o")
        ->excludes("--camera")
        ->excludes("--eye");
    command
        ->add_option("--backend", options->backend,
                     "Who draws: the CPU in every mode, or OpenGL, without a window, mode field")
        ->transform(CLI::CheckedTransformer(kBackendNames))
        ->option_text("cpu|gl [cpu]");
    addGpuOptions(*command, options->gpu);
    addModeOptions(*command, options->still);
    addDiagramOptions(*command, *options);
    addPictureOptions(*command, options->picture);
    command->add_option("--json", options->json, "Write a report to this file");
    command->footer(
        "Modes:\n"
        "  raytraced  diffuse light from the field, mirrors by tracing reflections\n"
        "  field      diffuse light and mirrors from the field, no reflection traced\n"
        "  wireframe  a line drawing; hidden edges faint\n"
        "  diagram    the structure of the field (--diagram)\n"
        "--exposure and --tone have no effect on drawings.\n\n"
        "Examples:\n"
        "  vlf render room.vlf --camera front --size 1024x768 -o front.png\n"
        "  vlf render room.vlf --all-cameras -o stills/%.png\n"
        "  vlf render room.vlf --mode diagram --diagram tile -o tile.png");
    command->callback([options, &globals] { run(*options, globals); });
}

}  // namespace vlf::app
