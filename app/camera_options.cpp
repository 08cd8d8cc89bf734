#include "camera_options.h"

#include "number_within.h"

#include "vlf/base/error.h"

#include <cstdio>

#include <fmt/format.h>

namespace vlf::app {

namespace {

bool parseSize(const std::string& text, int& width, int& height) {
    char rest = 0;
    return std::sscanf(text.c_str(), "%6dx%6d%c", &width, &height, &rest) == 2;
}

/// Empty if the text is a size, else what is wrong with it (a CLI11 validator).
std::string sizeProblem(const std::string& text) {
    int width = 0, height = 0;
    if (!parseSize(text, width, height) || width < 1 || height < 1)
        return "must be two whole numbers of pixels, as in 640x480";
    if (static_cast<std::size_t>(width) * height > kMaxPicturePixels)
        return fmt::format("is more than {} million pixels", kMaxPicturePixels / 1000000);
    return {};
}

Vec3 toVec3(const std::vector<float>& v) {
    return {v[0], v[1], v[2]};
}

Camera namedCamera(const std::string& name, const std::vector<Camera>& cameras) {
    std::string known;
    for (const Camera& camera : cameras) {
        if (camera.name == name) return camera;
        known += (known.empty() ? "" : ", ") + camera.name;
    }
    throw InputError(
        known.empty() ? fmt::format("no camera '{}': there are none; give --eye and --look", name)
                      : fmt::format("no camera '{}'; choose one of {}", name, known));
}

CLI::Option* addPoint(CLI::App& command, const char* name, std::vector<float>& value,
                      const char* meaning) {
    return command.add_option(name, value, meaning)
        ->delimiter(',')
        ->expected(3)
        ->type_name("X,Y,Z");
}

}  // namespace

void addCameraOptions(CLI::App& command, CameraOptions& options) {
    CLI::Option* name = command.add_option("--camera", options.name,
                                           "Camera of the scene, by name (else: its first)");
    CLI::Option* eye = addPoint(command, "--eye", options.eye, "Look from here, in metres");
    CLI::Option* look = addPoint(command, "--look", options.look, "Look at this point");
    addPoint(command, "--up", options.up, "This direction is up in the picture [0,1,0]");
    command.add_option("--fov", options.verticalFov, "Vertical field of view in degrees")
        ->check(numberWithin(0.01, 179));
    command
        .add_option_function<std::string>(
            "--size",
            [&options](const std::string& text) { parseSize(text, options.width, options.height); },
            "Width and height of the picture in pixels")
        ->check(sizeProblem, "size")
        ->type_name("WxH")
        ->default_str(fmt::format("{}x{}", options.width, options.height));
    eye->needs(look)->excludes(name);
    look->needs(eye);
}

Camera chooseCamera(const CameraOptions& options, const std::vector<Camera>& cameras,
                    const Camera& fallback) {
    Camera camera = cameras.empty() ? fallback : cameras.front();
    if (!options.name.empty()) camera = namedCamera(options.name, cameras);
    if (!options.eye.empty())
        camera = {"command line", toVec3(options.eye), toVec3(options.look), {0, 1, 0}, 50};
    overrideCamera(options, camera);
    return camera;
}

void overrideCamera(const CameraOptions& options, Camera& camera) {
    if (!options.up.empty()) camera.up = toVec3(options.up);
    if (options.verticalFov) camera.verticalFov = *options.verticalFov;
}

}  // namespace vlf::app
