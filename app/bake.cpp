// vlf bake: from scene files to a field file.

#include "bake_checkpoint.h"
#include "bake_options.h"
#include "camera_options.h"
#include "commands.h"
#include "console.h"
#include "picture_output.h"
#include "scene_input.h"

#include "vlf/base/error.h"
#include "vlf/io/field_file.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/bundle_sweep.h"
#include "vlf/propagate/memory.h"
#include "vlf/propagate/texel_plan.h"
#include "vlf/render/cpu/texel_picture.h"
#include "vlf/scene/scene_hash.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>
#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

struct Options {
    std::vector<std::string> scenes;
    EnvironmentOptions environment;
    QualityOptions quality;
    CameraOptions camera;  // of the error map
    std::string output, json, errorMap, instructionSet;
    double maxMemory = 0;         // GiB
    double checkpointEvery = 60;  // seconds; 0: never
    bool resume = false;
    bool adaptiveTexels = false;
};

Scene readScene(const Options& options, const Globals& globals) {
    Scene scene = readScenes(options.scenes, options.environment, globals);
    if (scene.cameras.empty()) scene.cameras.push_back(defaultCamera(scene));
    if (!hasLight(scene))
        printWarning(globals.quiet,
                     "the scene has no emitter and no environment: everything will be black");
    return scene;
}

std::uintmax_t fileBytes(const std::string& path) {
    return std::filesystem::is_regular_file(path) ? std::filesystem::file_size(path) : 0;
}

double peakMebibytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

nlohmann::ordered_json toJson(const Options& options, const BakeReport& report,
                              const BakeRecord& record, std::uint64_t predictedMemory, bool resumed,
                              double seconds) {
    nlohmann::ordered_json stages = nlohmann::ordered_json::array();
    for (const BakeReport::Stage& s : report.stages)
        stages.push_back({{"name", s.name}, {"seconds", s.seconds}, {"cpuSeconds", s.cpuSeconds}});
    nlohmann::ordered_json scales = nlohmann::ordered_json::array();
    for (const BakeReport::TexelScale& s : report.texelScales)
        scales.push_back({{"size", s.scale * record.texelSize}, {"texels", s.texels}});
    const EnergyReport& e = report.energy;
    return {{"scenes", options.scenes},
            {"output", options.output},
            {"preset", record.preset},
            {"instructionSet", record.instructionSet},
            {"directions", record.directions},
            {"cells", record.cells},
            {"texelSize", record.texelSize},
            {"texels", report.texels},
            {"texelSizes", scales},
            {"radianceElements", report.radianceElements},
            {"fileBytes", fileBytes(options.output)},
            {"exchanges", report.exchanges},
            {"bounces", report.sweeps},
            {"residual", report.residual},
            {"refinements", report.refinements},
            {"refinedLines", report.finalLines},
            {"estimatedError",
             {{"ofTexels", report.error.ofTexels()},
              {"interpolated", report.error.interpolated()},
              {"direct", report.error.direct},
              {"indirect", report.error.indirect},
              {"missing", report.error.missing},
              {"texelSize", report.error.texelSize}}},
            {"energy",
             {{"emitted", numbers(e.emitted)},
              {"absorbed", numbers(e.absorbed)},
              {"unshot", numbers(e.unshot)},
              {"escaped", numbers(e.escaped)}}},
            {"resumed", resumed},
            {"stages", stages},
            {"seconds", seconds},
            {"predictedMemoryMiB", static_cast<double>(predictedMemory) / (1024 * 1024)},
            {"peakMemoryMiB", peakMebibytes()}};
}

void printReport(const Options& options, const BakeReport& report, double seconds) {
    fmt::print("{}: {} texels, {} radiance elements, {:.1f} MB\n", options.output, report.texels,
               report.radianceElements, static_cast<double>(fileBytes(options.output)) / 1e6);
    for (const BakeReport::Stage& s : report.stages)
        fmt::print("  {:<16} {:7.2f} s  ({:.2f} s CPU)\n", s.name, s.seconds, s.cpuSeconds);
    const EnergyReport& e = report.energy;
    fmt::print("  {} bounces, {:.1f} M exchanges, light still missing {:.2g} %\n", report.sweeps,
               1e-6 * static_cast<double>(report.exchanges), 100 * report.residual);
    if (report.refinements > 0)
        fmt::print("  refined in {} steps to {} lines{}\n", report.refinements, report.finalLines,
                   options.quality.seconds > 0
                       ? fmt::format("; to repeat it: --refinements {}", report.refinements)
                       : "");
    const ErrorReport& error = report.error;
    fmt::print(
        "  estimated error {:.2g} % of the texels (direct light {:.2g}, indirect {:.2g}, missing "
        "{:.2g}), {:.2g} % with what lies between them\n",
        100 * error.ofTexels(), 100 * error.direct, 100 * error.indirect, 100 * error.missing,
        100 * error.interpolated());
    fmt::print("  energy: {:.4g} W emitted, {:.4g} W absorbed, {:.2g} W unshot, {:.4g} W escaped\n",
               luminance(e.emitted), luminance(e.absorbed), luminance(e.unshot),
               luminance(e.escaped));
    fmt::print("  {:.2f} s in all, peak memory {:.0f} MiB\n", seconds, peakMebibytes());
}

// Relative errors that the error map shows in black and in pale yellow.
constexpr float kLeastError = 1e-3f, kMostError = 0.1f;

void writeErrorMap(const Options& options, const BakedRoom& room, const Camera& camera,
                   const BakeReport& report, Progress& progress) {
    progress.stage("error map");
    const RayScene rays(room.scene);
    writeFinished(
        options.errorMap,
        drawTexelValues(room.scene, rays, room.field, report.texelErrors, kLeastError, kMostError,
                        camera, options.camera.width, options.camera.height, progress));
}

/// Writes the field, after which its checkpoint has had its day.
void write(const Options& options, const BakedRoom& room, const BakeCheckpoint& checkpoint) {
    try {
        writeField(options.output, room);
    } catch (const FileError& e) {
        if (!checkpoint.exists()) throw;
        throw Error(std::string(e.what()) + "; " + checkpoint.path() +
                    " keeps the bake: make room and go on with --resume");
    }
    checkpoint.remove();
}

/// Where files beside the output go; beside a device none may.
std::string folderOf(const std::string& output) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (fs::exists(output, ignored) && !fs::is_regular_file(output, ignored))
        return fs::temp_directory_path().string();
    const fs::path folder = fs::path(output).parent_path();
    return folder.empty() ? "." : folder.string();
}

/// What --max-memory allows, and where that goes which does not fit.
struct MemoryLimit {
    MemoryLimit(double gibibytes, const std::string& output)
        : bytes(static_cast<std::uint64_t>(gibibytes * 1024 * 1024 * 1024)) {
        scratch.folder = folderOf(output);
        scratch.largest = bytes > 0 ? bytes / 4 : SIZE_MAX;  // there are two radiance fields
    }

    std::uint64_t bytes;  ///< 0: any
    ScratchPlace scratch;
};

/// Throws if the output's folder has no room for so many bytes more.
void requireDisk(const std::string& output, std::uint64_t bytes) {
    std::error_code unknown;
    const auto space = std::filesystem::space(folderOf(output), unknown);
    if (bytes == 0 || unknown || space.available >= bytes) return;
    throw FileError(
        output, fmt::format("the bake needs {:.2g} GB beside it for a while, of which {:.2g} are "
                            "free: make room, or allow more memory (--max-memory)",
                            1e-9 * static_cast<double>(bytes),
                            1e-9 * static_cast<double>(space.available)));
}

/// Empty if the text is an interval, else what is wrong with it (a CLI11 validator).
std::string checkInterval(const std::string& text) {
    double seconds = 0;
    const bool fine = CLI::detail::lexical_cast(text, seconds) && seconds >= 0 && seconds <= 1e6;
    return fine ? "" : "must be seconds, from 0 to 1000000";
}

void run(const Options& options, const Globals& globals) {
    requireWritableOutputs({options.output, options.json, options.errorMap});
    const BakeOutput output(options.output);
    if (!options.instructionSet.empty()) useInstructionSet(options.instructionSet);
    const auto start = std::chrono::steady_clock::now();
    BakeParams params = bakeParams(options.quality, globals);
    params.adaptiveTexels = options.adaptiveTexels;
    BakedRoom room;
    room.scene = readScene(options, globals);
    const Camera camera =
        chooseCamera(options.camera, room.scene.cameras, room.scene.cameras.front());
    const MemoryLimit limit(options.maxMemory, options.output);
    if (limit.bytes > 0) requireMemory(room.scene, params, limit.bytes, &limit.scratch);
    const std::string hash = sceneHash(room.scene);
    const BakeCheckpoint checkpoint(output.checkpointPath(), params, hash);
    BakeSolution solution = beginning(checkpoint, limit.scratch, options.resume, globals.quiet);
    const bool resumed = options.resume && checkpoint.exists();
    BakeReport report;
    std::uint64_t predictedMemory = 0;
    {
        CheckpointProgress progress(globals.quiet, checkpoint, options.checkpointEvery);
        const auto keep = [&](const BakeState& state) {
            if (predictedMemory == 0) {
                const MemoryNeed need = predictMemory(state);
                predictedMemory = need.total();
                if (limit.bytes > 0) requireMemory(state, limit.bytes);
                requireDisk(options.output, need.scratch);
            }
            progress.keep(state);
        };
        if (params.adaptiveTexels) params.pieces = planTexels(room.scene, params, progress);
        room.field = bake(room.scene, params, progress, &report, keep, std::move(solution));
        progress.stage("writing");
        room.field.record.programVersion = VLF_VERSION;
        room.field.record.sceneHash = hash;
        write(options, room, checkpoint);
        if (!options.errorMap.empty()) writeErrorMap(options, room, camera, report, progress);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (!options.json.empty())
        writeJson(options.json, toJson(options, report, room.field.record, predictedMemory, resumed,
                                       seconds.count()));
    if (!globals.quiet) printReport(options, report, seconds.count());
}

}  // namespace

void addBake(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("bake", "Solve a scene's light and write a field file");
    command->add_option("scenes", options->scenes, "Scene files (.obj, .gltf, .glb), merged")
        ->required()
        ->type_name("SCENE...");
    command->add_option("-o,--output", options->output, "Field file to write (.vlf)")->required();
    addEnvironmentOptions(*command, options->environment);
    addQualityOptions(*command, options->quality);
    command->add_flag("--adaptive-texels", options->adaptiveTexels,
                      "Smaller texels where light bends, larger ones elsewhere");
    command
        ->add_option(
            "--max-memory", options->maxMemory,
            "Most memory to need, in GiB: what is larger is kept in files beside the output "
            "meanwhile, or refused")
        ->check(CLI::PositiveNumber);
    command->add_option("--isa", options->instructionSet,
                        "Instruction set of the sweeps, e.g. AVX2 (default: the best there is)");
    command
        ->add_option("--checkpoint", options->checkpointEvery,
                     "Seconds from checkpoint to checkpoint, from which --resume goes on (0: none)")
        ->capture_default_str()
        ->check(checkInterval);
    command->add_flag("--resume", options->resume, "Go on with a bake that was interrupted");
    command->add_option("--json", options->json, "Write a report of times, counts and energy");
    command
        ->add_option(
            "--error-map", options->errorMap,
            "Write a picture of the estimated error (.png): black 0.1 % of the light, pale "
            "yellow 10 %")
        ->check([](const std::string& path) {
            return path.ends_with(".png") ? "" : "must end in .png";
        });
    addCameraOptions(*command, options->camera);
    command->footer(
        "Examples:\n"
        "  vlf bake room.obj -o room.vlf\n"
        "  vlf bake room.glb lights.obj -o room.vlf --preset high --texel 0.03\n"
        "  vlf bake room.obj -o room.vlf --adaptive-texels\n"
        "  vlf bake room.obj -o room.vlf --error 1% --error-map error.png\n"
        "  vlf bake house.obj -o house.vlf --environment sky.hdr --environment-turn 90\n"
        "  vlf bake room.obj -o room.vlf --resume\n"
        "Ctrl-C stops and keeps what is done in room.vlf.checkpoint, from which --resume goes on.\n"
        "A field file that was there before is left as it was.");
    command->callback([options, &globals] { run(*options, globals); });
}

}  // namespace vlf::app
