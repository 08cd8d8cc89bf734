#pragma once
// The options of vlf render.

#include "camera_options.h"
#include "object_options.h"
#include "picture_output.h"

#include "vlf/display/stereo.h"
#include "vlf/render/gl/renderer.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace vlf::app {

enum class Backend { cpu, gl };

enum class StereoLayout { none, sideBySide, anaglyph, pair };

struct StereoOptions {
    StereoLayout layout = StereoLayout::none;
    EyePair eyes;
};

/// A time on a path: seconds, or the number of a frame.
struct Moment {
    double value = 0;
    bool isFrame = false;
};

/// A moving camera.
struct FilmOptions {
    std::string path;   ///< file of a camera path; empty: none
    bool tour = false;  ///< through the scene's cameras instead
    std::string film;   ///< the film to write; empty: pictures, named by the pattern -o
    double fps = 30;
    int crf = 18;  ///< quality of the film: x264's constant rate factor
    std::optional<Moment> from, to;
    std::string log;  ///< empty: none

    bool moves() const { return tour || !path.empty(); }
};

struct RenderOptions {
    std::string field;
    Backend backend = Backend::cpu;
    RendererOptions gpu;  ///< of backend gl
    CameraOptions camera;
    PictureOptions picture;
    StereoOptions stereo;
    FilmOptions film;
    ObjectOptions objects;
    std::string json;
    bool allCameras = false;
    std::vector<std::uint32_t> tile;
    StillParams still;
};

extern const std::map<std::string, DisplayMode> kModeNames;
extern const std::map<std::string, Backend> kBackendNames;
extern const std::map<std::string, LookupKind> kLookupNames;
extern const std::map<std::string, StereoLayout> kStereoNames;

template <typename Value>
std::string nameOf(const std::map<std::string, Value>& names, Value value) {
    for (const auto& [name, candidate] : names)
        if (candidate == value) return name;
    return {};
}

/// Declares all of them. `options` must outlive the parsing.
void addRenderOptions(CLI::App& command, RenderOptions& options);

/// Throws a usage error (CLI::Error) if options that were given do not go together.
void requireConsistent(const CLI::App& command, const RenderOptions& options);

/// The still of a camera that the options ask for.
StillParams stillParams(const RenderOptions& options, const Camera& camera);

/// How its picture is written: drawings are display colours already.
PictureOptions pictureOptions(const RenderOptions& options);

}  // namespace vlf::app
