// vlf compare: how far a picture is from a reference.

#include "commands.h"
#include "number_within.h"
#include "picture_output.h"

#include "vlf/base/error.h"
#include "vlf/image/flip.h"
#include "vlf/image/heat_map.h"
#include "vlf/image/image_io.h"
#include "vlf/image/metrics.h"
#include "vlf/image/tone_map.h"

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

struct Options {
    std::string test, reference, mask, json, heatMap;
    std::string exposure = "0";
    ToneCurve tone = ToneCurve::clamp;
    float pixelsPerDegree = kFlipPixelsPerDegree;
};

const std::map<std::string, ToneCurve> kToneNames{{"clamp", ToneCurve::clamp},
                                                  {"filmic", ToneCurve::filmic}};

struct Report {
    int width = 0, height = 0;
    float exposure = 0;
    double relMse = 0, relRmse = 0, psnr = 0;
    FlipResult flip;
};

Image readFiniteImage(const std::string& path) {
    Image image = readImage(path);
    const std::vector<std::size_t> bad = nonFinitePixels(image);
    if (bad.empty()) return image;
    throw InputError(fmt::format(
        "{}: {} of {} pixels are NaN or infinite, the first at x {}, y {}; render it again", path,
        bad.size(), image.pixels.size(), bad[0] % image.width, bad[0] / image.width));
}

/// Nonzero where the mask image is not black.
std::vector<std::uint8_t> readMask(const std::string& path, const Image& reference) {
    std::vector<std::uint8_t> mask;
    if (path.empty()) return mask;
    const Image image = readImage(path);
    if (image.width != reference.width || image.height != reference.height)
        throw InputError(fmt::format("{}: the mask is {}x{}, the images {}x{}", path, image.width,
                                     image.height, reference.width, reference.height));
    for (const Vec3& p : image.pixels) mask.push_back(maxComponent(p) > 0);
    return mask;
}

Report compare(const Options& options) {
    const Image test = readFiniteImage(options.test);
    const Image reference = readFiniteImage(options.reference);
    requireComparable(test, reference, {});
    const std::vector<std::uint8_t> mask = readMask(options.mask, reference);

    Report report;
    report.width = test.width;
    report.height = test.height;
    report.exposure = exposureOf(options.exposure, reference);
    report.relMse = relativeMse(test, reference, mask);
    report.relRmse = relativeRmse(test, reference, mask);
    const Image shownTest = toneMap(test, report.exposure, options.tone);
    const Image shownReference = toneMap(reference, report.exposure, options.tone);
    report.psnr = peakSignalToNoise(shownTest, shownReference, mask);
    report.flip = flip(shownTest, shownReference, options.pixelsPerDegree, mask);
    return report;
}

const char* toneName(ToneCurve tone) {
    return tone == ToneCurve::filmic ? "filmic" : "clamp";
}

nlohmann::ordered_json toJson(const Options& options, const Report& report) {
    nlohmann::ordered_json json{
        {"test", options.test},
        {"reference", options.reference},
        {"width", report.width},
        {"height", report.height},
        {"exposure", report.exposure},
        {"tone", toneName(options.tone)},
        {"pixelsPerDegree", options.pixelsPerDegree},
        {"relMse", report.relMse},
        {"relRmse", report.relRmse},
        {"psnr", report.psnr},
        {"flip", report.flip.mean},
    };
    if (!options.mask.empty()) json["mask"] = options.mask;
    return json;
}

void printRow(const char* name, const std::string& value, bool explain, const char* meaning) {
    if (explain)
        fmt::print("{:<10} {:>12}   {}\n", name, value, meaning);
    else
        fmt::print("{:<10} {:>12}\n", name, value);
}

void printReport(const Options& options, const Report& report, bool explain) {
    fmt::print("test       {}\nreference  {}\n", options.test, options.reference);
    if (!options.mask.empty()) fmt::print("mask       {}\n", options.mask);
    fmt::print("{}x{} pixels, exposure {:+.2f} EV, tone curve {}\n\n", report.width, report.height,
               report.exposure, toneName(options.tone));
    printRow("relMSE", fmt::format("{:.6g}", report.relMse), explain,
             "mean((I-R)^2 / (R^2 + 0.01)) of linear values; 0: equal, noise weighs like light");
    printRow("relRMSE", fmt::format("{:.6g}", report.relRmse), explain,
             "sqrt(sum (I-R)^2 / sum R^2) of linear values; 0.01: one per cent");
    printRow("PSNR", fmt::format("{:.2f} dB", report.psnr), explain,
             "of the tone-mapped, sRGB-encoded pictures; above 40 dB hard to see, inf: equal");
    printRow("FLIP", fmt::format("{:.5f}", report.flip.mean), explain,
             "perceived difference when flipping between the pictures; 0: equal, 1: the largest");
}

void run(const Options& options, const Globals& globals) {
    const Report report = compare(options);
    if (!options.heatMap.empty())
        writePng(options.heatMap, heatMap(report.flip.error, report.width, report.height));
    if (!options.json.empty()) writeJson(options.json, toJson(options, report));
    if (!globals.quiet) printReport(options, report, globals.verbose);
}

}  // namespace

void addCompare(CLI::App& app, const Globals& globals) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("compare", "Measure how far a picture is from another");
    command->add_option("test", options->test, "Picture to judge (EXR, HDR, PNG or JPEG)")
        ->required();
    command->add_option("reference", options->reference, "Picture to hold it against")->required();
    command->add_option("--json", options->json, "Write the numbers to this file (infinite: null)");
    command->add_option("--heatmap", options->heatMap,
                        "Write FLIP per pixel, dark to bright (PNG)");
    command->add_option("--mask", options->mask, "Count only pixels that are not black in this");
    command
        ->add_option("--exposure", options->exposure,
                     "EV applied to both before PSNR and FLIP; auto: from the reference")
        ->check(exposureProblem, "EV|auto")
        ->capture_default_str();
    command->add_option("--tone", options->tone, "Tone curve before PSNR and FLIP")
        ->transform(CLI::CheckedTransformer(kToneNames))
        ->option_text("clamp|filmic [clamp]");
    command->add_option("--ppd", options->pixelsPerDegree, "Pixels per degree of view, for FLIP")
        ->check(numberWithin(1, 1000))
        ->capture_default_str();
    command->footer(
        "PNG and JPEG are decoded from sRGB. relMSE and relRMSE compare linear values; PSNR and\n"
        "FLIP what is shown after exposure and tone curve. -v explains the numbers.\n\n"
        "Example:\n"
        "  vlf compare field.exr reference.exr --exposure auto --heatmap difference.png");
    command->callback([options, &globals] { run(*options, globals); });
}

}  // namespace vlf::app
