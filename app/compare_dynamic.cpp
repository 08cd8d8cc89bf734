// vlf compare-dynamic: objects in a baked room against the truth, the room baked again with them.

#include "bake_options.h"
#include "commands.h"
#include "console.h"
#include "dynamic_report.h"
#include "render_options.h"
#include "stopwatch.h"

#include "vlf/base/error.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/image/contact_sheet.h"
#include "vlf/image/heat_map.h"
#include "vlf/image/metrics.h"
#include "vlf/io/field_file.h"
#include "vlf/render/cpu/path_tracer.h"

#include <memory>
#include <string>

#include <fmt/format.h>

namespace vlf::app {

namespace {

enum class Truth { rebake, path };

const std::map<std::string, Truth> kTruthNames{{"rebake", Truth::rebake}, {"path", Truth::path}};
const std::map<std::string, DisplayMode> kComparedModes{{"raytraced", DisplayMode::raytraced},
                                                        {"field", DisplayMode::field}};

struct Options {
    std::string field;
    ObjectOptions objects;
    CameraOptions camera;
    DisplayMode mode = DisplayMode::raytraced;
    int antialias = 4;
    QualityOptions quality;
    bool preset = false;  ///< given
    Truth truth = Truth::rebake;
    int samplesPerPixel = 256;
    std::string output, json;
    std::string exposure = "auto";
};

/// One comparison, step by step.
class Comparison {
  public:
    Comparison(const Options& options, const Globals& globals)
        : options_(options),
          room_(readField(options.field)),
          rays_(room_.scene),
          scenario_(readObjects(options.objects, room_.scene, models_, globals)),
          objects_(room_.scene, rays_, room_.field) {
        if (scenario_.objects.empty()) throw InputError(options.objects.scenario + ": no objects");
        for (const ScenarioObject& object : scenario_.objects) objects_.add(object.object);
        moveTo(objects_, scenario_, options.objects.moment);
        still_.camera =
            chooseCamera(options.camera, room_.scene.cameras, defaultCamera(room_.scene));
        still_.width = options.camera.width, still_.height = options.camera.height;
        still_.mode = options.mode;
        still_.antialias = options.antialias;
    }

    DynamicReport run(Progress& progress) {
        progress.stage("objects");
        const Stopwatch lighting;
        objects_.update();
        report_.updateSeconds = lighting.seconds();
        still_.objects = &objects_;
        dynamic_ = renderStill(room_.scene, rays_, room_.field, still_, progress);
        still_.objects = nullptr;
        const Stopwatch truth;
        truth_ = options_.truth == Truth::path ? tracePaths(progress) : bakeAgain(progress);
        report_.truthSeconds = truth.seconds();
        compare();
        return report_;
    }

    /// Dynamic, truth and error side by side.
    Image sheet() const {
        const std::vector<Image> pictures{
            toneMap(dynamic_, report_.exposure, ToneCurve::filmic),
            toneMap(truth_, report_.exposure, ToneCurve::filmic),
            heatMap(report_.flip.error, dynamic_.width, dynamic_.height, kBrightestError)};
        ContactSheetLayout layout;
        layout.columns = 3;
        layout.cellWidth = dynamic_.width;
        return contactSheet(pictures, layout);
    }

    const DynamicRoom& objects() const { return objects_; }
    const Camera& camera() const { return still_.camera; }

  private:
    Image tracePaths(Progress& progress) {
        const Scene posed = posedScene(room_.scene, objectsAt(scenario_, options_.objects.moment));
        PathTraceParams params;
        params.camera = still_.camera;
        params.width = still_.width, params.height = still_.height;
        params.samplesPerPixel = options_.samplesPerPixel;
        const PathTraceResult result = pathTrace(posed, RayScene(posed), params, progress);
        progress.check();
        return result.image;
    }

    Image bakeAgain(Progress& progress) {
        const QualityOptions& quality = options_.quality;
        BakeRecord record = room_.field.record;
        BakeParams params = paramsOf(record);
        if (options_.preset) {
            params = presetParams(quality.preset);
            params.texelSize = record.texelSize;
            params.seed = record.seed;
        }
        params = withSettings(quality, params);
        if (options_.mode == DisplayMode::raytraced) params.radianceDirections = 0;
        const RebakedRoom rebaked = rebake(objects_, params, progress);
        report_.light = compareRoomLight(objects_, rebaked.field);
        return renderStill(rebaked.scene, RayScene(rebaked.scene), rebaked.field, still_, progress);
    }

    void compare() {
        report_.exposure = exposureOf(options_.exposure, truth_);
        report_.relMse = relativeMse(dynamic_, truth_);
        report_.flip = flip(toneMap(dynamic_, report_.exposure, ToneCurve::filmic),
                            toneMap(truth_, report_.exposure, ToneCurve::filmic));
        report_.faces = compareFaces(objects_, rays_, still_.camera, dynamic_, truth_);
    }

    const Options& options_;
    BakedRoom room_;
    RayScene rays_;
    ModelLibrary models_;
    Scenario scenario_;
    DynamicRoom objects_;
    StillParams still_;
    Image dynamic_, truth_;
    DynamicReport report_;
};

/// Throws a usage error (CLI::Error) if options that were given do not go together.
void requireConsistent(const CLI::App& command, const CLI::Option_group& quality,
                       const Options& options) {
    if (!options.objects.any()) throw CLI::RequiredError("--object or --scenario");
    if (options.truth != Truth::path && command.count("--spp") > 0)
        throw CLI::ValidationError("--spp", "needs --truth path");
    if (options.truth == Truth::path && quality.count_all() > 0)
        throw CLI::ValidationError("--truth path",
                                   "bakes nothing: leave out --preset and what goes with it");
}

void run(const Options& options, const Globals& globals) {
    requireWritableOutputs({options.output, options.json});
    Comparison comparison(options, globals);
    DynamicReport report;
    {
        ConsoleProgress progress(globals.quiet);
        report = comparison.run(progress);
    }
    if (!options.output.empty()) writePng(options.output, comparison.sheet());
    if (!options.json.empty()) {
        nlohmann::ordered_json json{{"field", options.field},
                                    {"camera", comparison.camera().name},
                                    {"width", options.camera.width},
                                    {"height", options.camera.height},
                                    {"mode", nameOf(kComparedModes, options.mode)},
                                    {"truth", nameOf(kTruthNames, options.truth)}};
        json.update(toJson(report, comparison.objects()));
        writeJson(options.json, json);
    }
    if (!globals.quiet) printReport(report, comparison.objects());
}

void addComparisonOptions(CLI::App& command, Options& options) {
    command.add_option("field", options.field, "Field file (.vlf)")->required()->type_name("FIELD");
    addObjectOptions(command, options.objects);
    addMomentOption(command, options.objects);
    addCameraOptions(command, options.camera);
    command.add_option("--mode", options.mode, "How both pictures are made")
        ->transform(CLI::CheckedTransformer(kComparedModes))
        ->option_text("raytraced|field [raytraced]");
    command.add_option("--antialias", options.antialias, "Up to N x N rays per pixel")
        ->check(CLI::Range(1, 16))
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--truth", options.truth, "Bake the room with the objects, or trace paths")
        ->transform(CLI::CheckedTransformer(kTruthNames))
        ->option_text("rebake|path [rebake]");
    command.add_option("--spp", options.samplesPerPixel, "Truth path: samples per pixel")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command
        .add_option("-o,--output", options.output,
                    "Sheet to write (.png): dynamic, truth, FLIP per pixel")
        ->check(
            [](const std::string& path) {
                return path.ends_with(".png") ? std::string() : path + " must end in .png";
            },
            "sheet name")
        ->type_name("FILE");
    command.add_option("--exposure", options.exposure, "EV of both; auto: from the truth")
        ->check(exposureProblem, "exposure")
        ->type_name("EV|auto")
        ->capture_default_str();
    command.add_option("--json", options.json, "Write the numbers to this file");
}

}  // namespace

void addCompareDynamic(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "compare-dynamic", "Hold objects in a baked room against the room baked again with them");
    addComparisonOptions(*command, *options);
    CLI::Option_group* quality = addQualityOptions(*command, options->quality);
    quality->get_option("--preset")->default_str("as the field");
    command->footer(
        objectHelp() +
        "\nThe objects are lit as in vlf render, and the room is baked again with them as part of\n"
        "it, by the settings that the field was baked with unless others are given. Reported are\n"
        "  FLIP, relMSE   of the pictures, as by vlf compare\n"
        "  faces          mean radiance of every visible face of the objects against the truth\n"
        "  room           irradiance of the room's texels against those baked again, relRMSE;\n"
        "                 and of those that the objects change, in per cent of the change\n"
        "A face that is off by more than a few per cent in soft light, or a change by more than\n"
        "ten, points at a fault of the method; sheets show where it lies.\n\n"
        "Examples:\n"
        "  vlf compare-dynamic room.vlf --object cube:0.3:red@1,0.15,2 -o sheet.png\n"
        "  vlf compare-dynamic room.vlf --scenario walk.json --moment 2.5 --json report.json\n"
        "  vlf compare-dynamic room.vlf --object sphere:mirror --mode field --truth path");
    command->callback([command, quality, options, &globals] {
        requireConsistent(*command, *quality, *options);
        options->preset = command->count("--preset") > 0;
        run(*options, globals);
    });
}

}  // namespace vlf::app
