// mirror_quality FIELD.vlf --json R [--width W] [--height H]: what mirrors show by lookup in the
// radiance field, against their traced reflections, on the pixels whose centre shows a mirror.
//
// PSNR as by `vlf compare --exposure auto`, with rays as `vlf render` takes them and with one ray
// through the centre of each pixel; and the CPU time of one thread per mirror pixel.
// bench/mirror_table.py makes the table of docs/benchmarks.md.

#include "vlf/image/metrics.h"
#include "vlf/image/tone_map.h"
#include "vlf/io/field_file.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/field_shader.h"
#include "vlf/render/cpu/still.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <span>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace {

using namespace vlf;
using Json = nlohmann::ordered_json;

constexpr int kAntialias = 4;              // of `vlf render`
constexpr std::size_t kRaysAtOnce = 1024;  // as many as a tile of a picture has pixels
constexpr int kRepeats = 3;

struct Options {
    std::string field, json;
    int width = 640, height = 480;
};

/// What the centres of a camera's mirror pixels show.
struct MirrorPixels {
    std::vector<std::uint8_t> mask;  ///< of the picture; the rest: of each pixel in it
    std::vector<MirrorPoint> points;
    std::vector<Vec3> toEye;
    std::vector<Ray> reflections;
};

class MirrorQuality {
  public:
    MirrorQuality(const BakedRoom& room, const Options& options)
        : room_(room), options_(options), rays_(room.scene) {}

    Json measure(const Camera& camera) const {
        const MirrorPixels pixels = findMirrorPixels(camera);
        if (pixels.points.empty()) return {};
        return {{"camera", camera.name},
                {"pixels", pixels.points.size()},
                {"antialiased", quality(camera, pixels, kAntialias)},
                {"oneRay", quality(camera, pixels, 1)},
                {"nanoseconds", times(pixels)}};
    }

  private:
    MirrorPixels findMirrorPixels(const Camera& camera) const {
        const CameraRays view(camera, options_.width, options_.height);
        MirrorPixels pixels;
        for (int y = 0; y < options_.height; ++y)
            for (int x = 0; x < options_.width; ++x) {
                const Ray ray =
                    view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                const Hit hit = rays_.closest(ray);
                const bool isMirror = hit && room_.scene.material(hit.triangle).isMirror();
                pixels.mask.push_back(isMirror);
                if (isMirror) add(ray, hit, pixels);
            }
        return pixels;
    }

    void add(const Ray& ray, const Hit& hit, MirrorPixels& pixels) const {
        const SidePoint place = pointFacing(room_.scene, hit, ray.direction);
        const std::uint32_t chart = chartAt(room_.field, place);
        Surface surface = surfaceAt(room_.scene, place);
        if (room_.field.charts[chart].planar) surface.normal = surface.geometricNormal;
        pixels.points.push_back({chart, surface.position, surface.geometricNormal});
        pixels.toEye.push_back(-ray.direction);
        pixels.reflections.push_back({surface.position + rays_.epsilon() * surface.geometricNormal,
                                      mirrorDirection(surface, ray.direction)});
    }

    Image picture(const Camera& camera, int antialias, DisplayMode mode, LookupKind lookup) const {
        StillParams params;
        params.camera = camera;
        params.width = options_.width;
        params.height = options_.height;
        params.antialias = antialias;
        params.mode = mode;
        params.lookup = lookup;
        Progress progress;
        return renderStill(room_.scene, rays_, room_.field, params, progress);
    }

    /// PSNR in dB of both kinds of lookup.
    Json quality(const Camera& camera, const MirrorPixels& pixels, int antialias) const {
        const Image traced = picture(camera, antialias, DisplayMode::raytraced, LookupKind::plain);
        const float exposure = autoExposure(traced);
        const auto psnr = [&](LookupKind lookup) {
            const Image looked = picture(camera, antialias, DisplayMode::field, lookup);
            return peakSignalToNoise(toneMap(looked, exposure, ToneCurve::clamp),
                                     toneMap(traced, exposure, ToneCurve::clamp), pixels.mask);
        };
        return {{"plain", psnr(LookupKind::plain)},
                {"depthCorrected", psnr(LookupKind::depthCorrected)}};
    }

    /// CPU time per mirror pixel of the three ways, without that of finding the mirror.
    Json times(const MirrorPixels& pixels) const {
        const MirrorLookup lookup(room_.field.frame, room_.field.radiance);
        const FieldShader shader(room_.scene, rays_, room_.field);
        const auto lookUp = [&](LookupKind kind) {
            return nanoseconds(pixels, [&](std::size_t first, std::span<Vec3> seen) {
                for (std::size_t i = 0; i < seen.size(); ++i)
                    seen[i] = lookup.mirrorRadiance(pixels.points[first + i],
                                                    pixels.toEye[first + i], kind);
            });
        };
        const auto trace = [&](std::size_t first, std::span<Vec3> seen) {
            shader.radiance(std::span(pixels.reflections).subspan(first, seen.size()), seen);
        };
        return {{"plain", lookUp(LookupKind::plain)},
                {"depthCorrected", lookUp(LookupKind::depthCorrected)},
                {"traced", nanoseconds(pixels, trace)}};
    }

    /// Least CPU time of some runs of look(first pixel, colours), per pixel.
    template <class Look>
    static double nanoseconds(const MirrorPixels& pixels, const Look& look) {
        std::vector<Vec3> seen(pixels.points.size());
        std::clock_t least = std::numeric_limits<std::clock_t>::max();
        for (int repeat = 0; repeat < kRepeats; ++repeat) {
            const std::clock_t start = std::clock();
            for (std::size_t i = 0; i < seen.size(); i += kRaysAtOnce)
                look(i, std::span(seen).subspan(i, std::min(kRaysAtOnce, seen.size() - i)));
            least = std::min(least, std::clock() - start);
        }
        return 1e9 * static_cast<double>(least) / CLOCKS_PER_SEC / static_cast<double>(seen.size());
    }

    const BakedRoom& room_;
    const Options& options_;
    RayScene rays_;
};

void run(const Options& options) {
    const BakedRoom room = readField(options.field);
    const MirrorQuality quality(room, options);
    Json cameras = Json::array();
    for (const Camera& camera : room.scene.cameras)
        if (Json measured = quality.measure(camera); !measured.empty())
            cameras.push_back(std::move(measured));
    std::ofstream(options.json) << Json{{"field", options.field}, {"cameras", cameras}}.dump(2)
                                << "\n";
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Mirrors by lookup against their traced reflections");
    app.add_option("field", options.field, "Field file (.vlf)")->required();
    app.add_option("--width", options.width, "Pixels")->capture_default_str();
    app.add_option("--height", options.height, "Pixels")->capture_default_str();
    app.add_option("--json", options.json, "Report to write")->required();
    CLI11_PARSE(app, argc, argv);
    try {
        run(options);
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << "\n";
        return 1;
    }
}
