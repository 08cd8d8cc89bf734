// gloss_quality FIELD.vlf --json R [--spp N] [--width W] [--height H]: what rough mirrors show by
// lookup, against path tracing (twice N paths a pixel), on the pixels whose centre shows one; and
// how far the truth is off by its noise: half of what its two halves differ by.
// bench/gloss_table.py makes the table of docs/benchmarks.md.

#include "vlf/image/flip.h"
#include "vlf/image/tone_map.h"
#include "vlf/io/field_file.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/path_tracer.h"
#include "vlf/render/cpu/still.h"

#include <algorithm>
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace {

using namespace vlf;
using Json = nlohmann::ordered_json;

struct Options {
    std::string field, json;
    int width = 120, height = 90, spp = 4096;
};

std::vector<std::uint8_t> roughPixels(const Scene& scene, const RayScene& rays,
                                      const Camera& camera, const Options& o) {
    const CameraRays view(camera, o.width, o.height);
    std::vector<std::uint8_t> mask;
    for (int y = 0; y < o.height; ++y)
        for (int x = 0; x < o.width; ++x) {
            const Hit hit =
                rays.closest(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
            mask.push_back(hit && scene.material(hit.triangle).isGlossy());
        }
    return mask;
}

Image mean(const Image& a, const Image& b) {
    Image image = a;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
    return image;
}

Json measure(const BakedRoom& room, const RayScene& rays, const Camera& camera, const Options& o) {
    const std::vector<std::uint8_t> mask = roughPixels(room.scene, rays, camera, o);
    const auto pixels = std::count(mask.begin(), mask.end(), 1);
    if (pixels == 0) return {};
    Progress progress;
    PathTraceParams paths;
    paths.camera = camera;
    paths.width = o.width;
    paths.height = o.height;
    paths.samplesPerPixel = o.spp;
    const Image one = pathTrace(room.scene, rays, paths, progress).image;
    paths.seed = 1;
    const Image other = pathTrace(room.scene, rays, paths, progress).image;
    const Image truth = mean(one, other);
    StillParams still;
    still.camera = camera;
    still.width = o.width;
    still.height = o.height;
    still.mode = DisplayMode::field;
    const Image looked = renderStill(room.scene, rays, room.field, still, progress);
    const float exposure = autoExposure(truth);
    const auto flipOf = [&](const Image& a, const Image& b) {
        return flip(toneMap(a, exposure, ToneCurve::clamp), toneMap(b, exposure, ToneCurve::clamp),
                    kFlipPixelsPerDegree, mask)
            .mean;
    };
    return {{"camera", camera.name},
            {"pixels", pixels},
            {"flip", flipOf(looked, truth)},
            {"flipOfNoise", 0.5 * flipOf(one, other)}};
}

void run(const Options& o) {
    const BakedRoom room = readField(o.field);
    const RayScene rays(room.scene);
    Json cameras = Json::array();
    for (const Camera& camera : room.scene.cameras)
        if (Json measured = measure(room, rays, camera, o); !measured.empty())
            cameras.push_back(std::move(measured));
    std::ofstream(o.json) << Json{{"field", o.field}, {"cameras", cameras}}.dump(2) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    CLI::App app("Rough mirrors by lookup against path tracing");
    app.add_option("field", o.field, "Field file (.vlf)")->required();
    app.add_option("--width", o.width, "Pixels")->capture_default_str();
    app.add_option("--height", o.height, "Pixels")->capture_default_str();
    app.add_option("--spp", o.spp, "Paths a pixel")->capture_default_str();
    app.add_option("--json", o.json, "Report to write")->required();
    CLI11_PARSE(app, argc, argv);
    try {
        run(o);
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << "\n";
        return 1;
    }
}
