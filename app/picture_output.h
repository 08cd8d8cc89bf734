#pragma once
// Writing what a command has computed: pictures by the ending of their name, reports as JSON.

#include "vlf/image/image_io.h"
#include "vlf/image/tone_map.h"

#include <initializer_list>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

namespace vlf::app {

struct PictureOptions {
    std::string path;               ///< .exr: linear radiance; .png: tone-mapped, for looking at
    std::string exposure = "auto";  ///< of a .png: "auto" or EV
    ToneCurve tone = ToneCurve::filmic;  ///< of a .png
};

/// Empty if pictures can be written under this name, else what is wrong (a CLI11 validator).
std::string pictureNameProblem(const std::string& path);

/// Declares -o/--output (required), --exposure and --tone. `options` must outlive the parsing.
/// `orReport`: the output may be a .json as well.
void addPictureOptions(CLI::App& command, PictureOptions& options, bool orReport = false);

/// Empty if the text is an exposure, else what is wrong with it (a CLI11 validator).
std::string exposureProblem(const std::string& text);

/// EV: what the text says, or of "auto" what brings the picture to middle grey.
float exposureOf(const std::string& text, const Image& radiance);

/// Throws FileError if one of the files cannot be written; an empty name is none. To be asked
/// before long work.
void requireWritableOutputs(std::initializer_list<std::string> paths);

/// Whether a file of this name holds radiance; otherwise it holds colours for a display.
bool writesRadiance(const std::string& path);

/// Writes a picture as it is: radiance, or display-linear colours, see writesRadiance.
void writeFinished(const std::string& path, const Image& picture,
                   const ImageAttributes& attributes = {});

/// Writes radiance to the file the options name; `attributes` go into the header of an EXR.
void writePicture(const PictureOptions& options, const Image& radiance,
                  const ImageAttributes& attributes = {});

/// The components, for a report.
std::vector<float> numbers(const Vec3& v);

/// Writes a report, indented.
void writeJson(const std::string& path, const nlohmann::ordered_json& report);

}  // namespace vlf::app
