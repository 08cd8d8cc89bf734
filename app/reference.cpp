// vlf reference: a picture by unbiased path tracing, the truth for every other picture.

#include "camera_options.h"
#include "commands.h"
#include "console.h"
#include "number_within.h"
#include "picture_output.h"
#include "reference_irradiance.h"
#include "scene_input.h"

#include "vlf/base/error.h"
#include "vlf/render/cpu/path_tracer.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

struct Options {
    std::vector<std::string> scenes;
    EnvironmentOptions environment;
    CameraOptions camera;
    PictureOptions picture;
    std::string json, variance;
    int samplesPerPixel = 0;
    double targetError = 0, maxSeconds = 0;
    int maxDepth = 0;
    std::string field;  // .vlf whose irradiance is to be measured
    int texels = 0;
    bool texelPoints = false, interpolated = false;
};

PathTraceParams traceParams(const Options& options, const Globals& globals, const Scene& scene) {
    PathTraceParams params;
    params.camera = chooseCamera(options.camera, scene.cameras, defaultCamera(scene));
    params.width = options.camera.width;
    params.height = options.camera.height;
    params.samplesPerPixel = options.samplesPerPixel;
    params.targetError = options.targetError;
    params.maxSeconds = options.maxSeconds;
    params.seed = globals.seed;
    params.paths.maxDepth = options.maxDepth;
    return params;
}

const char* stopName(PathTraceStop stop) {
    switch (stop) {
        case PathTraceStop::samples:
            return "samples";
        case PathTraceStop::error:
            return "error";
        case PathTraceStop::time:
            return "time";
        default:
            return "cancelled";
    }
}

nlohmann::ordered_json toJson(const Camera& camera) {
    return {{"name", camera.name},
            {"eye", numbers(camera.eye)},
            {"look", numbers(camera.look)},
            {"up", numbers(camera.up)},
            {"verticalFov", camera.verticalFov}};
}

/// Infinite errors (pixels without two samples) become null.
nlohmann::ordered_json toJson(const Options& options, const PathTraceParams& params,
                              const PathTraceResult& result) {
    return {{"scenes", options.scenes},
            {"camera", toJson(params.camera)},
            {"width", params.width},
            {"height", params.height},
            {"seed", params.seed},
            {"maxDepth", params.paths.maxDepth},
            {"samplesPerPixel", result.samplesPerPixel},
            {"relativeError", result.relativeError},
            {"seconds", result.seconds},
            {"stop", stopName(result.stop)},
            {"output", options.picture.path}};
}

void writeResult(const Options& options, const PathTraceParams& params,
                 const PathTraceResult& result) {
    const ImageAttributes attributes{
        {"vlf.samplesPerPixel", fmt::format("{:.6g}", result.samplesPerPixel)},
        {"vlf.relativeError", fmt::format("{:.6g}", result.relativeError)},
        {"vlf.seed", std::to_string(params.seed)}};
    writePicture(options.picture, result.image, attributes);
    if (!options.variance.empty()) writeExr(options.variance, result.variance, attributes);
    if (!options.json.empty()) writeJson(options.json, toJson(options, params, result));
}

void run(const Options& options, const Globals& globals) {
    if (!options.field.empty()) {
        if (options.samplesPerPixel <= 0)
            throw CLI::ValidationError("--irradiance", "needs --spp, the samples per texel");
        return runIrradianceReference(
            {options.scenes, options.environment, options.field, options.picture.path,
             options.samplesPerPixel, options.texels, options.texelPoints, options.interpolated},
            globals);
    }
    if (const std::string problem = pictureNameProblem(options.picture.path); !problem.empty())
        throw CLI::ValidationError("--output", problem);
    requireWritableOutputs({options.picture.path, options.variance, options.json});
    const Scene scene = readScenes(options.scenes, options.environment, globals);
    const PathTraceParams params = traceParams(options, globals, scene);
    PathTraceResult result;
    {
        ConsoleProgress progress(globals.quiet);
        result = pathTrace(scene, RayScene(scene), params, progress);
    }
    writeResult(options, params, result);
    if (!globals.quiet)
        fmt::print("{}: {:.4g} samples per pixel in {:.1f} s, relative error {:.3g}\n",
                   options.picture.path, result.samplesPerPixel, result.seconds,
                   result.relativeError);
    if (result.stop == PathTraceStop::cancelled) throw Cancelled();
}

void addLimits(CLI::App& command, Options& options) {
    CLI::Option_group* limits = command.add_option_group(
        "Limits", "When to stop: at the first of these; at least one is needed");
    limits->add_option("--spp", options.samplesPerPixel, "Samples per pixel")
        ->check(CLI::Range(1, 1 << 30));
    limits
        ->add_option("--error", options.targetError,
                     "Expected relative error through noise (root of relMSE), e.g. 0.01")
        ->check(numberWithin(1e-6, 1e3));
    limits->add_option("--max-seconds", options.maxSeconds, "Time for the tracing")
        ->check(numberWithin(0.001, 1e9));
    limits->require_option(1, 0);
}

void addIrradianceOptions(CLI::App& command, Options& options) {
    CLI::Option* irradiance =
        command.add_option("--irradiance", options.field,
                           "Measure the irradiance of this field file (.vlf) instead; -o is the "
                           "report (.json), --spp the samples per texel");
    for (const char* ofPictures : {"--camera", "--eye", "--up", "--fov", "--size", "--exposure",
                                   "--tone", "--variance", "--max-depth", "--json"})
        irradiance->excludes(command.get_option(ofPictures));
    command.add_option("--texels", options.texels, "Texels to measure (0: all)")
        ->check(CLI::Range(0, 1 << 30))
        ->needs(irradiance);
    command
        .add_flag("--texel-points", options.texelPoints,
                  "Report the points of the surface that each texel stands for")
        ->needs(irradiance);
    command
        .add_flag("--interpolated", options.interpolated,
                  "Measure the light as it is shown, interpolated between texels, at a random "
                  "point of each instead of its mean over the texel")
        ->needs(irradiance);
}

}  // namespace

void addReference(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("reference", "Path-trace a picture of a scene, free of bias");
    command->add_option("scenes", options->scenes, "Scene files (.obj, .gltf, .glb), merged")
        ->required()
        ->type_name("SCENE...");
    addEnvironmentOptions(*command, options->environment);
    addCameraOptions(*command, options->camera);
    addLimits(*command, *options);
    addPictureOptions(*command, options->picture, true);
    command->add_option("--variance", options->variance,
                        "Write the variance of every pixel's mean (.exr)");
    command
        ->add_option("--max-depth", options->maxDepth,
                     "Longest path in segments: 1 emitters, 2 direct light; 0 unlimited")
        ->check(CLI::Range(0, 1 << 20))
        ->capture_default_str();
    command->add_option("--json", options->json, "Write a report to this file");
    addIrradianceOptions(*command, *options);
    command->footer(
        "Ctrl-C writes the picture as far as it has come.\n\n"
        "Example:\n"
        "  vlf reference room.obj --camera front --size 800x600 --error 0.02 -o reference.exr\n"
        "  vlf reference room.obj --irradiance room.vlf --spp 4096 --texels 2000 -o error.json");
    command->callback([options, &globals] { run(*options, globals); });
}

}  // namespace vlf::app
