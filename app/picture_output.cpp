#include "picture_output.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

const std::map<std::string, ToneCurve> kToneNames{{"filmic", ToneCurve::filmic},
                                                  {"linear", ToneCurve::clamp}};

std::string lowerExtension(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace

std::string exposureProblem(const std::string& text) {
    double value = 0;
    if (text == "auto" || (CLI::detail::lexical_cast(text, value) && std::abs(value) <= 100))
        return {};
    return "must be auto or a number of EV between -100 and 100";
}

float exposureOf(const std::string& text, const Image& radiance) {
    return text == "auto" ? autoExposure(radiance) : std::stof(text);
}

std::string pictureNameProblem(const std::string& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".exr" || extension == ".png" ? "" : path + " must end in .exr or .png";
}

void addPictureOptions(CLI::App& command, PictureOptions& options, bool orReport) {
    const auto nameProblem = [orReport](const std::string& path) {
        return orReport && lowerExtension(path) == ".json" ? "" : pictureNameProblem(path);
    };
    command
        .add_option("-o,--output", options.path,
                    "Picture to write: .exr (linear radiance) or .png (tone-mapped)")
        ->required()
        ->check(nameProblem, "picture name")
        ->type_name("FILE");
    command.add_option("--exposure", options.exposure, "EV applied to a .png; auto: middle grey")
        ->check(exposureProblem, "exposure")
        ->type_name("EV|auto")
        ->capture_default_str();
    command.add_option("--tone", options.tone, "Tone curve of a .png")
        ->transform(CLI::CheckedTransformer(kToneNames))
        ->option_text("filmic|linear [filmic]");
}

void requireWritableOutputs(std::initializer_list<std::string> paths) {
    for (const std::string& path : paths)
        if (!path.empty()) requireWritable(path);
}

bool writesRadiance(const std::string& path) {
    return lowerExtension(path) == ".exr";
}

void writeFinished(const std::string& path, const Image& picture,
                   const ImageAttributes& attributes) {
    if (writesRadiance(path)) return writeExr(path, picture, attributes);
    writePng(path, picture);
}

void writePicture(const PictureOptions& options, const Image& radiance,
                  const ImageAttributes& attributes) {
    if (writesRadiance(options.path)) return writeExr(options.path, radiance, attributes);
    writePng(options.path, toneMap(radiance, exposureOf(options.exposure, radiance), options.tone));
}

std::vector<float> numbers(const Vec3& v) {
    return {v.x, v.y, v.z};
}

void writeJson(const std::string& path, const nlohmann::ordered_json& report) {
    // Names of files need not be UTF-8.
    const std::string text =
        report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace vlf::app
