#pragma once
// Choosing a camera and a size on the command line.

#include "vlf/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace vlf::app {

/// Pictures of more pixels than this are refused.
inline constexpr std::size_t kMaxPicturePixels = std::size_t{1} << 25;

struct CameraOptions {
    std::string name;                  ///< empty: the first camera
    std::vector<float> eye, look, up;  ///< three numbers each, or empty: not given
    std::optional<float> verticalFov;  ///< degrees
    int width = 640, height = 480;     ///< pixels
};

/// Declares --camera, --eye, --look, --up, --fov and --size. `options` must outlive the parsing.
void addCameraOptions(CLI::App& command, CameraOptions& options);

/// The camera that the options ask for: from --eye, or from `cameras` by name, or the first of
/// them, or `fallback`; --up and --fov change any of these. Throws InputError, naming all cameras,
/// if there is none of that name.
Camera chooseCamera(const CameraOptions& options, const std::vector<Camera>& cameras,
                    const Camera& fallback);

/// Applies --up and --fov, where they are given.
void overrideCamera(const CameraOptions& options, Camera& camera);

}  // namespace vlf::app
