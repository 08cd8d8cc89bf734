#include "reference_irradiance.h"

#include "console.h"
#include "picture_output.h"

#include "vlf/base/error.h"
#include "vlf/io/field_file.h"
#include "vlf/math/random.h"
#include "vlf/render/cpu/irradiance_error.h"
#include "vlf/scene/import/import.h"
#include "vlf/scene/scene_hash.h"
#include "vlf/unwrap/unwrap.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

void requireSameScene(const IrradianceOptions& options, const BakedRoom& room) {
    ImportReport report;
    Scene scene = importScene(options.scenes, report);
    scene.environment = environmentOf(options.environment);
    if (sceneHash(scene) != room.field.record.sceneHash)
        throw InputError(options.field + ": was baked from another scene than " +
                         options.scenes.front() +
                         ": bake it again, or name the files it is from and their environment");
}

/// Texels that scatter light: what falls on a black surface, a lamp or a plain mirror, is never
/// seen.
std::vector<std::size_t> scatteringTexels(const Scene& scene, const Unwrap& unwrap) {
    std::vector<std::size_t> texels;
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i) {
        const Chart& chart = unwrap.charts[unwrap.texelChart[i]];
        if (maxComponent(scene.materials[chart.material].diffuse) > 0) texels.push_back(i);
    }
    return texels;
}

/// Of these `count` spread evenly over the atlas: one at random of each of as many equal strata.
std::vector<std::size_t> chooseTexels(const std::vector<std::size_t>& texels, int count,
                                      std::uint64_t seed) {
    const std::size_t available = texels.size();
    const std::size_t n = count > 0 ? std::min<std::size_t>(count, available) : available;
    std::vector<std::size_t> chosen(n);
    RandomStream random(seed, 0x7e8e1);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t begin = i * available / n, end = (i + 1) * available / n;
        chosen[i] = texels[begin + static_cast<std::size_t>(random.next() *
                                                            static_cast<float>(end - begin))];
    }
    return chosen;
}

/// The chosen texels as the estimator and the report want them.
struct Selection {
    std::vector<std::vector<SidePoint>> points;
    std::vector<std::vector<Vec3>> positions;  // of the points
    std::vector<Vec3> normal, baked;
    std::vector<char> flat;  // shaded as lying in one plane
    std::vector<float> area;
};

/// Curved surfaces have facets too, with shading normals of their own.
bool isFlat(const Scene& scene, const Chart& chart, std::span<const SurfacePoint> points) {
    return chart.planar && std::all_of(points.begin(), points.end(), [&](const SurfacePoint& p) {
               const Vec3 n = shadingNormalAt(scene, p.triangle, p.barycentric);
               return std::abs(glm::dot(n, chart.normal)) > 0.99999f;
           });
}

/// What stands for a texel: its points, or one of them.
std::span<const SurfacePoint> pointsOf(const Unwrap& unwrap, std::size_t i, bool onlyOne,
                                       std::uint64_t seed) {
    const auto points = unwrap.points.of(i);
    if (!onlyOne) return points;
    RandomStream random(seed, mixBits(i));
    const float u = random.next() * static_cast<float>(points.size());
    return points.subspan(std::min(static_cast<std::size_t>(u), points.size() - 1), 1);
}

Selection select(const BakedRoom& room, const Unwrap& unwrap,
                 const std::vector<std::size_t>& texels, bool interpolated, std::uint64_t seed) {
    Selection s;
    for (const std::size_t i : texels) {
        const std::uint32_t chart = unwrap.texelChart[i];
        const auto texelPoints = pointsOf(unwrap, i, interpolated, seed);
        std::vector<SidePoint>& points = s.points.emplace_back();
        std::vector<Vec3>& positions = s.positions.emplace_back();
        for (const SurfacePoint& p : texelPoints) {
            const bool front = unwrap.triangleCharts[p.triangle].front == chart;
            points.push_back({p.triangle, p.barycentric, front});
            positions.push_back(positionAt(room.scene, p.triangle, p.barycentric));
        }
        s.normal.push_back(unwrap.charts[chart].normal);
        s.flat.push_back(isFlat(room.scene, unwrap.charts[chart], texelPoints));
        const Chart& c = unwrap.charts[chart];
        const IrradianceAtlas& atlas = room.field.atlas;
        s.baked.push_back(interpolated ? atlas.sample(c, c.texelCoordinates(positions[0]))
                                       : atlas.irradiance[unwrap.texels[i]]);
        s.area.push_back(unwrap.texelArea(i));
    }
    return s;
}

nlohmann::ordered_json toJson(const Selection& s, std::size_t i, const IrradianceEstimate& truth,
                              bool withPoints) {
    const std::vector<Vec3>& positions = s.positions[i];
    const Vec3 sum = std::accumulate(positions.begin(), positions.end(), Vec3(0));
    nlohmann::ordered_json texel = {
        {"position", numbers(sum / static_cast<float>(positions.size()))},
        {"normal", numbers(s.normal[i])},
        {"flat", static_cast<bool>(s.flat[i])},
        {"baked", numbers(s.baked[i])},
        {"irradiance", numbers(truth.mean)},
        {"standardError", numbers(truth.standardError)},
        {"samples", truth.samples},
        {"area", s.area[i]}};
    for (const Vec3& p : positions)
        if (withPoints) texel["points"].push_back(numbers(p));
    return texel;
}

nlohmann::ordered_json toJson(const IrradianceOptions& options, const IrradianceError& error,
                              const Selection& s, const std::vector<IrradianceEstimate>& truth,
                              double cpuSeconds) {
    nlohmann::ordered_json texels = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < truth.size(); ++i)
        texels.push_back(toJson(s, i, truth[i], options.points));
    return {{"scenes", options.scenes},
            {"field", options.field},
            {"samplesPerTexel", options.samplesPerTexel},
            {"relativeRmse", error.relativeRmse},
            {"measuredRmse", error.measuredRmse},
            {"truthError", error.truthError},
            {"bias", error.bias},
            {"biasError", error.biasError},
            {"meanRelative", error.meanRelative},
            {"cpuSeconds", cpuSeconds},
            {"texels", texels}};
}

}  // namespace

void runIrradianceReference(const IrradianceOptions& options, const Globals& globals) {
    requireWritableOutputs({options.output});
    const BakedRoom room = readField(options.field);
    requireSameScene(options, room);
    const LightField& field = room.field;
    const RayScene rays(room.scene);
    const Unwrap unwrap = restoreUnwrap(room.scene, rays, field.charts, field.triangleCharts,
                                        {field.atlas.width, field.atlas.height});
    const Selection s =
        select(room, unwrap,
               chooseTexels(scatteringTexels(room.scene, unwrap), options.texels, globals.seed),
               options.interpolated, globals.seed);
    const std::vector<TexelArea> areas(s.points.begin(), s.points.end());
    const auto isOpen = [&](std::uint32_t triangle, bool front) {
        const TriangleCharts& c = field.triangleCharts[triangle];
        return (front ? c.front : c.back) != kNoChart;
    };
    IrradianceParams params;
    params.samplesPerTexel = options.samplesPerTexel;
    params.seed = globals.seed;
    const std::clock_t start = std::clock();
    ConsoleProgress progress(globals.quiet);
    const auto truth = estimateIrradiance(room.scene, rays, areas, isOpen, params, progress);
    const double cpuSeconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const IrradianceError error = compareIrradiance(s.baked, truth, s.area);
    writeJson(options.output, toJson(options, error, s, truth, cpuSeconds));
    if (!globals.quiet)
        fmt::print(
            "{} texels: relative RMSE {:.3f} %, bias {:+.4f} % (± {:.4f}), mean relative "
            "error {:.2f} %; the truth's own error {:.3f} %\n",
            error.texels, 100 * error.relativeRmse, 100 * error.bias, 100 * error.biasError,
            100 * error.meanRelative, 100 * error.truthError);
}

}  // namespace vlf::app
