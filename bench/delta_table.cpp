// delta_table ROOM.vlf [options]
// A white cube moved about in a baked room: time and memory of an update, and its light against a
// new bake with the cube as a part of the room.

#include "vlf/base/parallel.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/dynamic/rebake.h"
#include "vlf/io/field_file.h"
#include "vlf/propagate/bake.h"
#include "vlf/scene/generate/primitives.h"

#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace vlf;
using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point since) {
    return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
}

/// Resident, of the process.
double megabytes() {
    std::size_t size = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> size >> resident;
    return 1e-6 * static_cast<double>(resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
}

struct Options {
    std::string file;
    float size = 0.1f;
    std::vector<float> at;
    int frames = 60, threads = 0;
    std::string truth;
    std::string shadow = "field";
    bool flat = false;
    int subdivision = -1;
};

ObjectSettings settingsOf(const Options& o) {
    ObjectSettings settings;
    settings.shadow = o.shadow == "none"   ? ShadowKind::none
                      : o.shadow == "soft" ? ShadowKind::soft
                                           : ShadowKind::field;
    if (o.flat) settings.shading = Shading::flat;
    if (o.subdivision >= 0) {
        settings.gather.points = GatherPoints::vertices;
        settings.gather.subdivision = o.subdivision;
    }
    return settings;
}

DynamicObject makeCube(const Options& o, const Vec3& at) {
    Material material;
    material.diffuse = Vec3(0.8f);
    DynamicObject cube;
    cube.model = std::make_shared<ObjectModel>(makePrimitive("cube", material));
    cube.pose.scale = o.size;
    cube.pose.translation = at;
    cube.settings = settingsOf(o);
    return cube;
}

/// Of the processor, by all threads, in milliseconds.
double cpuMilliseconds() {
    return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void measureTimes(DynamicRoom& room, int frames) {
    const Pose home = room.object(0).pose;
    double sum = 0, least = 1e9, cpu = 0;
    UpdateTimes leastOf;
    for (int i = 0; i < frames; ++i) {
        Pose pose = home;
        pose.translation += 0.05f * Vec3(std::sin(0.3f * i), 0, std::cos(0.3f * i));
        room.setPose(0, pose);
        const auto start = Clock::now();
        const double cpuStart = cpuMilliseconds();
        room.update();
        const double t = milliseconds(start);
        cpu += cpuMilliseconds() - cpuStart;
        sum += t;
        least = std::min(least, t);
        const UpdateTimes& u = room.updateTimes();
        for (auto stage : {&UpdateTimes::place, &UpdateTimes::look, &UpdateTimes::shadows,
                           &UpdateTimes::exchange})
            leastOf.*stage = i == 0 ? u.*stage : std::min(leastOf.*stage, u.*stage);
    }
    std::printf("update: %.2f ms mean, %.2f ms least, %.2f ms of the processors; ", sum / frames,
                least, cpu / frames);
    std::printf("least of place %.2f look %.2f shadows %.2f exchange %.2f ms\n",
                1e3 * leastOf.place, 1e3 * leastOf.look, 1e3 * leastOf.shadows,
                1e3 * leastOf.exchange);
    room.setPose(0, home);
    room.update();
}

/// Of texels, by area; luminance of irradiance.
struct Sums {
    double error2 = 0, truth2 = 0, change2 = 0, error = 0, change = 0, area = 0;

    void add(double area_, double without, double mine, double truth) {
        error2 += area_ * (mine - truth) * (mine - truth);
        truth2 += area_ * truth * truth;
        change2 += area_ * (truth - without) * (truth - without);
        error += area_ * (mine - truth);
        change += area_ * (truth - without);
        area += area_;
    }
    void print(const char* name) const {
        std::printf(
            "%-22s relRMSE %.3f %%  error / change %.3f  (flux: change %+.4f W, off by %+.4f)"
            "  %.2f m2\n",
            name, 100 * std::sqrt(error2 / truth2), std::sqrt(error2 / change2), change, error,
            area);
    }
};

/// Whether the object lies on or over a texel: its light is of no interest.
bool isCovered(const Scene& scene, std::span<const SurfacePoint> points, const Vec3& normal,
               const RayScene& posedRays, const Pose& pose) {
    return std::any_of(points.begin(), points.end(), [&](const SurfacePoint& p) {
        const Vec3 from = positionAt(scene, p.triangle, p.barycentric);
        const Ray up{from + 1e-4f * normal, normal, 0, 2e-3f};
        return posedRays.closest(up) || maxComponent(glm::abs(pose.inversePoint(from))) < 0.51f;
    });
}

void compareRoom(const BakedRoom& baked, const DynamicRoom& room, const Scene& posed,
                 const LightField& truth) {
    const RayScene rays(baked.scene), posedRays(posed);
    const Unwrap unwrap =
        restoreUnwrap(baked.scene, rays, baked.field.charts, baked.field.triangleCharts,
                      {baked.field.atlas.width, baked.field.atlas.height});
    Sums all, floor, changed;
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i) {
        const SurfacePoint& p = unwrap.points.of(i)[0];
        const bool front = baked.field.triangleCharts[p.triangle].front == unwrap.texelChart[i];
        const TriangleCharts& charts = truth.triangleCharts[p.triangle];
        const std::uint32_t c = front ? charts.front : charts.back;
        if (c == kNoChart) continue;
        const Chart& own = baked.field.charts[unwrap.texelChart[i]];
        const Chart& other = truth.charts[c];
        if (own.width != other.width || own.height != other.height) continue;
        const Vec3 at = positionAt(baked.scene, p.triangle, p.barycentric);
        if (isCovered(baked.scene, unwrap.points.of(i), own.normal, posedRays,
                      room.object(0).pose) ||
            isConcealed(baked.scene, rays, baked.field.triangleCharts, p.triangle, front, at,
                        own.texelSize()))
            continue;
        const std::uint32_t x = unwrap.texels[i] % unwrap.atlasWidth - own.x;
        const std::uint32_t y = unwrap.texels[i] / unwrap.atlasWidth - own.y;
        const double with = luminance(truth.atlas.at(other.x + x, other.y + y));
        const double without = luminance(baked.field.atlas.irradiance[unwrap.texels[i]]);
        const double mine = luminance(room.irradiance().irradiance[unwrap.texels[i]]);
        const double area = unwrap.texelArea(i);
        all.add(area, without, mine, with);
        if (own.normal.y > 0.99f && at.y < 0.01f) floor.add(area, without, mine, with);
        // By both: noise of either would else choose those that it favours.
        if (std::abs(0.5 * (with + mine) - without) > 0.02 * without)
            changed.add(area, without, mine, with);
    }
    all.print("whole room");
    floor.print("floor");
    changed.print("changed by over 2 %");
}

/// Mean irradiance of the cube's faces, two triangles each.
void compareFaces(const DynamicRoom& room, const Scene& posed, const LightField& truth) {
    const LitObject& lit = room.litObjects()[0];
    const auto triangles = static_cast<std::uint32_t>(lit.mesh->scene.triangles.size());
    const auto first = static_cast<std::uint32_t>(posed.triangles.size()) - triangles;
    for (std::uint32_t face = 0; face < triangles; face += 2) {
        Vec3 mine(0), theirs(0);
        int count = 0;
        for (std::uint32_t k = face; k < face + 2; ++k)
            for (int i = 0; i < 20; ++i)
                for (int j = 0; i + j < 20; ++j, ++count) {
                    const Vec2 b((i + 0.33f) / 20, (j + 0.33f) / 20);
                    mine += lit.irradiance(k, b, true);
                    const std::uint32_t c = truth.triangleCharts[first + k].front;
                    if (c == kNoChart) continue;
                    const Vec3 p = positionAt(posed, first + k, b);
                    theirs +=
                        truth.atlas.sample(truth.charts[c], truth.charts[c].texelCoordinates(p));
                }
        const Vec3 n = geometricNormal(posed, first + face);
        std::printf("face (%+.0f %+.0f %+.0f): E %.4f, new bake %.4f: %+.2f %%\n", n.x, n.y, n.z,
                    luminance(mine) / count, luminance(theirs) / count,
                    100 * (luminance(mine) / luminance(theirs) - 1));
    }
}

/// Of the file, or baked and written there.
LightField truthOf(const Scene& posed, const BakeRecord& record, const std::string& file) {
    if (!file.empty() && std::filesystem::exists(file)) return readField(file).field;
    Progress progress;
    const auto start = Clock::now();
    BakeParams params = paramsOf(record);
    params.radianceDirections = 0;
    LightField truth = bake(posed, params, progress);
    std::printf("new bake: %.2f s\n", 1e-3 * milliseconds(start));
    if (!file.empty()) writeField(file, {posed, truth});
    return truth;
}

void compare(const BakedRoom& baked, const DynamicRoom& room, const std::string& file) {
    const DynamicObject object = room.object(0);
    const Scene posed = posedScene(baked.scene, {&object, 1});
    const LightField truth = truthOf(posed, baked.field.record, file);
    compareRoom(baked, room, posed, truth);
    compareFaces(room, posed, truth);
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    CLI::App app{"A white cube moved about in a baked room: time, memory and error of its light"};
    app.add_option("room", o.file, "a baked room")->required();
    app.add_option("--size", o.size, "metres");
    app.add_option("--at", o.at, "x,y,z of its middle")->delimiter(',')->expected(3);
    app.add_option("--frames", o.frames, "moved ones that are timed");
    app.add_option("--truth", o.truth,
                   "file of the new bake, which is kept there for the next time; none: no bake");
    app.add_option("--shadow", o.shadow)->check(CLI::IsMember({"none", "soft", "field"}));
    app.add_flag("--flat", o.flat, "shading flat: no light is gathered for the cube");
    app.add_option("--vertices", o.subdivision, "gathers at vertices, subdivided so often");
    app.add_option("--threads", o.threads, "0: one per core");
    CLI11_PARSE(app, argc, argv);
    const ThreadLimit limit(o.threads);
    const BakedRoom baked = readField(o.file);
    const Vec3 at = o.at.empty() ? boundsOf(baked.scene).centre() : Vec3(o.at[0], o.at[1], o.at[2]);
    const RayScene rays(baked.scene);
    const double before = megabytes();
    auto start = Clock::now();
    DynamicRoom room(baked.scene, rays, baked.field);
    const double ready = megabytes();
    std::printf("making ready: %.1f ms", milliseconds(start));
    room.add(makeCube(o, at));
    start = Clock::now();
    room.update();
    std::printf(", first update: %.1f ms\n", milliseconds(start));
    if (o.frames > 0) measureTimes(room, o.frames);
    std::printf("memory beyond the field: %.1f MB for the room, %.1f MB more with the cube\n",
                ready - before, megabytes() - ready);
    if (o.truth != "none") compare(baked, room, o.truth);
}
