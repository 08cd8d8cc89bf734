// shading_table ROOM.vlf [--object cube|sphere|knot] [--size METRES] [--at X,Y,Z] [--paths N]
//
// What each way of shading an object takes and how far off it is: milliseconds of an update as the
// object moves (least and median of many), nanoseconds a receiver and direction where light is
// gathered, and the error of irradiance over its surface against path tracing of the room with the
// object in it (relative RMSE, mean of the relative error of its faces).

#include "vlf/base/parallel.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/io/field_file.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/render/cpu/path_integrator.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace vlf;

constexpr int kPoints = 384;  // of the surface, where the error is measured
constexpr int kFrames = 60;

struct Options {
    std::string file, object = "cube";
    float size = 0.3f;
    std::vector<float> at;
    int paths = 4096;
};

struct SurfacePlace {
    std::uint32_t triangle;
    Vec2 barycentric;
    double truth = 0;  ///< luminance of irradiance, W·m⁻²
};

/// Points spread evenly over the object, and the light there by path tracing.
std::vector<SurfacePlace> findTruth(const BakedRoom& room, const DynamicObject& object, int paths) {
    const Scene posed = posedScene(room.scene, {&object, 1});
    const RayScene rays(posed);
    const PathIntegrator integrator(posed, rays);
    const Scene& mesh = object.model->scene();
    std::vector<double> areas;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        areas.push_back((areas.empty() ? 0 : areas.back()) + area(mesh, t));
    std::vector<SurfacePlace> places(kPoints);
    parallelFor(places.size(), [&](std::size_t i) {
        RandomStream random(1, i);
        const double at = (static_cast<double>(i) + random.next()) / kPoints * areas.back();
        SurfacePlace& place = places[i];
        place.triangle = static_cast<std::uint32_t>(
            std::upper_bound(areas.begin(), areas.end() - 1, at) - areas.begin());
        place.barycentric = sampleUniformTriangle(random.next2());
        const auto first = static_cast<std::uint32_t>(room.scene.triangles.size());
        const SidePoint point{first + place.triangle, place.barycentric, true};
        glm::dvec3 sum(0);
        for (int k = 0; k < paths; ++k)
            sum += *integrator.irradiance(
                point, [](std::uint32_t, bool) { return true; }, random);
        place.truth = luminance(Vec3(sum)) / paths;
    });
    return places;
}

struct Error {
    double relative = 0, mean = 0;  ///< RMSE by RMS; of the sums
};

Error errorOf(const LitObject& lit, int subdivision, const std::vector<SurfacePlace>& places) {
    double squares = 0, truths = 0, sum = 0, truthSum = 0;
    for (const SurfacePlace& place : places) {
        // The same place in the subdivided mesh.
        std::uint32_t triangle = place.triangle;
        Vec2 b = place.barycentric;
        for (int level = 0; level < subdivision; ++level) {
            const Vec2 doubled = 2.0f * b;
            triangle *= 4;
            if (doubled.x >= 1)
                triangle += 1, b = {doubled.x - 1, doubled.y};
            else if (doubled.y >= 1)
                triangle += 2, b = {doubled.x, doubled.y - 1};
            else if (doubled.x + doubled.y <= 1)
                b = doubled;
            else
                // Corners ab, bc, ca of the middle one.
                triangle += 3, b = {doubled.x + doubled.y - 1, 1 - doubled.x};
        }
        const double found = luminance(lit.irradiance(triangle, b, true));
        squares += (found - place.truth) * (found - place.truth);
        truths += place.truth * place.truth;
        sum += found, truthSum += place.truth;
    }
    return {std::sqrt(squares / truths), sum / truthSum - 1};
}

struct Times {
    double least = 0, median = 0;  ///< ms
};

Times timeOf(DynamicRoom& room) {
    const Pose home = room.object(0).pose;
    std::vector<double> times;
    for (int i = 1; i <= kFrames; ++i) {
        Pose pose = home;
        const float turn = 0.2f * static_cast<float>(i);
        pose.translation += 0.03f * Vec3(std::sin(turn), 0, std::cos(turn) - 1);
        room.setPose(0, pose);
        const auto start = std::chrono::steady_clock::now();
        room.update();
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        times.push_back(took.count());
    }
    room.setPose(0, home);
    room.update();
    std::sort(times.begin(), times.end());
    return {times.front(), times[times.size() / 2]};
}

void measure(const char* name, DynamicRoom& room, const ObjectSettings& settings,
             const std::vector<SurfacePlace>& places) {
    room.setSettings(0, settings);
    room.update();
    const Times times = timeOf(room);
    const bool texels =
        settings.shading == Shading::gather && settings.gather.points == GatherPoints::texels;
    const int subdivision = texels ? 0 : settings.gather.subdivision;
    const LitObject& lit = room.litObjects()[0];
    const Error error = errorOf(lit, subdivision, places);
    std::printf("%-34s %8.2f %8.2f", name, times.least, times.median);
    if (settings.shading == Shading::gather && !texels)
        std::printf(" %7zu %7.1f", lit.vertexIrradiance.size(),
                    1e6 * times.least / static_cast<double>(lit.vertexIrradiance.size()) /
                        settings.gather.lines);
    else
        std::printf(" %7s %7s", "", "");
    std::printf(" %8.2f %+8.2f\n", 100 * error.relative, 100 * error.mean);
}

void run(const Options& o) {
    const BakedRoom baked = readField(o.file);
    const RayScene rays(baked.scene);
    DynamicRoom room(baked.scene, rays, baked.field);
    Material white;
    white.diffuse = Vec3(0.8f);
    DynamicObject object;
    object.model = std::make_shared<ObjectModel>(makePrimitive(o.object, white));
    object.pose.scale = o.size;
    object.pose.translation =
        o.at.empty() ? boundsOf(baked.scene).centre() : Vec3(o.at[0], o.at[1], o.at[2]);
    object.settings.shadow = ShadowKind::none;
    room.add(object);
    const std::vector<SurfacePlace> places = findTruth(baked, object, o.paths);
    std::printf("%-34s %8s %8s %7s %7s %8s %8s\n", "shading", "least ms", "median", "points", "ns",
                "error %", "mean %");
    ObjectSettings s = object.settings;
    const auto with = [&](const char* name, auto change) {
        ObjectSettings changed = s;
        change(changed);
        measure(name, room, changed, places);
    };
    with("flat", [](ObjectSettings& c) { c.shading = Shading::flat; });
    with("lights", [](ObjectSettings& c) { c.shading = Shading::lights; });
    with("prt", [](ObjectSettings& c) { c.shading = Shading::prt; });
    for (int level = 0; level <= 3; ++level)
        with(("gather, vertices, subdivision " + std::to_string(level)).c_str(),
             [&](ObjectSettings& c) {
                 c.gather.points = GatherPoints::vertices;
                 c.gather.subdivision = level;
             });
    const auto vertices = [](ObjectSettings& c) {
        c.gather.points = GatherPoints::vertices;
        c.gather.subdivision = 2;
    };
    with("  2, every other direction", [&](ObjectSettings& c) { vertices(c), c.gather.step = 2; });
    with("  2, 256 directions by importance",
         [&](ObjectSettings& c) { vertices(c), c.gather.importanceSamples = 256; });
    with("  2, cached", [&](ObjectSettings& c) { vertices(c), c.gather.cache = true; });
    with("  2, 2049 directions", [&](ObjectSettings& c) { vertices(c), c.gather.lines = 2049; });
    for (int level = 0; level <= 3; ++level)
        with(("  " + std::to_string(level) + ", emitters by the directions").c_str(),
             [&](ObjectSettings& c) {
                 c.gather.points = GatherPoints::vertices;
                 c.gather.subdivision = level;
                 c.gather.emittersByDirections = true;
             });
    with("gather, texels", [](ObjectSettings&) {});
    with("gather, texels, and shadows field",
         [](ObjectSettings& c) { c.shadow = ShadowKind::field; });
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("What each way of shading an object takes and how far off it is");
    app.add_option("field", options.file, "Field file")->required();
    app.add_option("--object", options.object, "cube, sphere or knot");
    app.add_option("--size", options.size, "From side to side, metres");
    app.add_option("--at", options.at, "Its middle, metres")->delimiter(',')->expected(3);
    app.add_option("--paths", options.paths, "At each of the points of the truth");
    CLI11_PARSE(app, argc, argv);
    try {
        run(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
