#include "render_options.h"

#include "frame_names.h"
#include "gpu_options.h"
#include "number_within.h"

#include "vlf/display/frame_log.h"

#include <fmt/format.h>

namespace vlf::app {

const std::map<std::string, DisplayMode> kModeNames{{"raytraced", DisplayMode::raytraced},
                                                    {"field", DisplayMode::field},
                                                    {"progressive", DisplayMode::progressive},
                                                    {"wireframe", DisplayMode::wireframe},
                                                    {"diagram", DisplayMode::diagram}};
const std::map<std::string, Backend> kBackendNames{{"cpu", Backend::cpu}, {"gl", Backend::gl}};
const std::map<std::string, LookupKind> kLookupNames{{"depth", LookupKind::depthCorrected},
                                                     {"plain", LookupKind::plain}};
const std::map<std::string, StereoLayout> kStereoNames{{"none", StereoLayout::none},
                                                       {"side-by-side", StereoLayout::sideBySide},
                                                       {"anaglyph", StereoLayout::anaglyph},
                                                       {"pair", StereoLayout::pair}};

namespace {

const std::map<std::string, DiagramKind> kDiagramNames{{"directions", DiagramKind::directions},
                                                       {"subfield", DiagramKind::subfield},
                                                       {"tile", DiagramKind::tile},
                                                       {"chart", DiagramKind::chart}};

/// Parses "2.5", "2.5s" or "75f"; nothing if the text is something else.
std::optional<Moment> parseMoment(std::string text) {
    Moment moment;
    if (text.ends_with('f')) moment.isFrame = true;
    if (text.ends_with('f') || text.ends_with('s')) text.pop_back();
    if (!CLI::detail::lexical_cast(text, moment.value)) return {};
    if (!(moment.value >= 0 && moment.value <= 1e9)) return {};
    return moment;
}

std::string momentProblem(const std::string& text) {
    return parseMoment(text) ? "" : "must be seconds, as in 2.5, or a frame, as in 75f";
}

std::string filmNameProblem(const std::string& path) {
    return path.ends_with(".mp4") ? "" : path + " must end in .mp4";
}

void addModeOptions(CLI::App& command, StillParams& still) {
    command.add_option("--mode", still.mode, "What to show; see below")
        ->transform(CLI::CheckedTransformer(kModeNames))
        ->option_text("raytraced|field|progressive|wireframe|diagram [raytraced]");
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

void addDiagramOptions(CLI::App& command, RenderOptions& options) {
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

void addStereoOptions(CLI::App& command, StereoOptions& stereo) {
    CLI::Option* layout =
        command.add_option("--stereo", stereo.layout, "A picture for each eye; see below")
            ->transform(CLI::CheckedTransformer(kStereoNames))
            ->option_text("none|side-by-side|anaglyph|pair [none]");
    command.add_option("--eye-separation", stereo.eyes.separation, "Between the eyes [0.064]")
        ->check(numberWithin(0, 1000))
        ->type_name("METRES")
        ->needs(layout);
    command
        .add_option("--convergence", stereo.eyes.convergence,
                    "What is this far away appears in the plane of the screen [infinity]")
        ->check(numberWithin(1e-3, 1e6))
        ->type_name("METRES")
        ->needs(layout);
    for (const char* name : {"--stereo", "--eye-separation", "--convergence"})
        command.get_option(name)->group("Two eyes");
}

void addMoment(CLI::App& command, const char* name, std::optional<Moment>& moment,
               const char* meaning) {
    command
        .add_option_function<std::string>(
            name, [&moment](const std::string& text) { moment = parseMoment(text); }, meaning)
        ->check(momentProblem, "moment")
        ->type_name("SECONDS|FRAMEf");
}

void addFilmOptions(CLI::App& command, FilmOptions& film) {
    CLI::Option* path =
        command.add_option("--path", film.path, "Move the camera along this path (.json)")
            ->type_name("FILE");
    CLI::Option* tour =
        command.add_flag("--tour", film.tour, "Move the camera from camera to camera of the scene")
            ->excludes(path);
    for (const char* fixed : {"--camera", "--eye", "--all-cameras"})
        for (CLI::Option* moving : {path, tour}) moving->excludes(command.get_option(fixed));
    CLI::Option* output =
        command.add_option("--film", film.film, "Write a film (.mp4) instead, with ffmpeg")
            ->check(filmNameProblem, "film name")
            ->type_name("FILE")
            ->excludes("--output");
    command.add_option("--fps", film.fps, "Frames a second of the path")
        ->check(numberWithin(0.1, 1000))
        ->capture_default_str();
    command.add_option("--crf", film.crf, "Quality of the film: x264's constant rate factor")
        ->check(CLI::Range(1, 51))
        ->capture_default_str()
        ->needs(output);
    addMoment(command, "--from", film.from, "First moment of the path to show [0]");
    addMoment(command, "--to", film.to, "Moment to stop before [the end]");
    command.add_option("--log", film.log, "Write every frame's times and pose (.csv or .json)")
        ->check(frameLogNameProblem, "log name")
        ->type_name("FILE");
    for (const char* name :
         {"--path", "--tour", "--film", "--fps", "--crf", "--from", "--to", "--log"})
        command.get_option(name)->group("Moving camera");
}

void requirePictureNames(const RenderOptions& options) {
    const std::string& path = options.picture.path;
    if (path.empty() && options.film.film.empty())
        throw CLI::RequiredError(options.film.moves() ? "--output or --film" : "--output");
    if (options.film.moves() && !path.empty())
        if (const std::string problem = framePatternProblem(path); !problem.empty())
            throw CLI::ValidationError("-o", problem);
    if (options.allCameras && path.find('%') == std::string::npos)
        throw CLI::ValidationError("-o", "needs a % for the cameras' names with --all-cameras");
    if (options.stereo.layout == StereoLayout::anaglyph && writesRadiance(path))
        throw CLI::ValidationError("--stereo anaglyph",
                                   "is made for a display; write a .png or a --film");
}

}  // namespace

void addRenderOptions(CLI::App& command, RenderOptions& options) {
    command.add_option("field", options.field, "Field file (.vlf)")->required()->type_name("FIELD");
    addCameraOptions(command, options.camera);
    command
        .add_flag("--all-cameras", options.allCameras,
                  "A picture from every camera, its name in place of % in -o")
        ->excludes("--camera")
        ->excludes("--eye");
    command
        .add_option("--backend", options.backend, "Who draws: the CPU, or OpenGL without a window")
        ->transform(CLI::CheckedTransformer(kBackendNames))
        ->option_text("cpu|gl [cpu]");
    addGpuOptions(command, options.gpu);
    addModeOptions(command, options.still);
    addDiagramOptions(command, options);
    addPictureOptions(command, options.picture);
    command.get_option("--output")->required(false);  // or --film
    addStereoOptions(command, options.stereo);
    addFilmOptions(command, options.film);
    addObjectOptions(command, options.objects);
    addMomentOption(command, options.objects)->excludes("--path")->excludes("--tour");
    command.add_option("--json", options.json, "Write a report to this file");
}

void requireConsistent(const CLI::App& command, const RenderOptions& options) {
    if (!options.film.moves())
        for (const char* option : {"--film", "--fps", "--from", "--to", "--log"})
            if (command.count(option) > 0)
                throw CLI::ValidationError(option, "needs a moving camera: --path or --tour");
    requirePictureNames(options);
    // H.264 keeps colours for blocks of 2 x 2 pixels.
    if (!options.film.film.empty() && (options.camera.width % 2 || options.camera.height % 2))
        throw CLI::ValidationError("--size",
                                   fmt::format("of a film must be even, as in {}x{}",
                                               options.camera.width + options.camera.width % 2,
                                               options.camera.height + options.camera.height % 2));
}

StillParams stillParams(const RenderOptions& options, const Camera& camera) {
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

PictureOptions pictureOptions(const RenderOptions& options) {
    PictureOptions picture = options.picture;
    if (!showsRadiance(options.still.mode)) {
        picture.exposure = "0";
        picture.tone = ToneCurve::clamp;
    }
    return picture;
}

}  // namespace vlf::app
