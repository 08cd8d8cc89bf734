// delta_table ROOM.vlf [--size METRES] [--at X,Y,Z] [--frames N] [--high]
// A white cube moved about in a baked room: time of an update, and its light against a new bake
// with the cube as a part of the room.

#include "vlf/base/parallel.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/io/field_file.h"
#include "vlf/propagate/bake.h"
#include "vlf/scene/generate/primitives.h"

#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>

namespace {

using namespace vlf;
using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point since) {
    return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
}

struct Options {
    std::string file;
    float size = 0.1f;
    Vec3 at{0};
    bool placed = false;
    int frames = 60;
    ObjectSettings settings;
    Vec3 colour{0.8f};
};

DynamicObject makeCube(const Options& o) {
    Material material;
    material.diffuse = o.colour;
    DynamicObject cube;
    cube.model = std::make_shared<ObjectModel>(makePrimitive("cube", material));
    cube.pose.scale = o.size;
    cube.pose.translation = o.at;
    cube.settings = o.settings;
    return cube;
}

void measureTimes(DynamicRoom& room, const Options& o) {
    double sum = 0, least = 1e9;
    for (int i = 0; i < o.frames; ++i) {
        Pose pose = room.object(0).pose;
        pose.translation = o.at + 0.05f * Vec3(std::sin(0.3f * i), 0, std::cos(0.3f * i));
        room.setPose(0, pose);
        const auto start = Clock::now();
        room.update();
        const double t = milliseconds(start);
        sum += t;
        least = std::min(least, t);
    }
    std::printf("update: %.2f ms mean, %.2f ms least; ", sum / o.frames, least);
    const UpdateTimes& t = room.updateTimes();
    std::printf("the last: place %.2f look %.2f shadows %.2f exchange %.2f ms\n", 1e3 * t.place,
                1e3 * t.look, 1e3 * t.shadows, 1e3 * t.exchange);
    Pose pose = room.object(0).pose;
    pose.translation = o.at;
    room.setPose(0, pose);
    room.update();
}

BakeParams paramsOf(const BakeRecord& r) {
    BakeParams p = presetParams(r.preset == "custom" ? "standard" : r.preset);
    p.directions = r.directions;
    p.cells = r.cells;
    p.texelSize = r.texelSize;
    p.directSamples = r.directSamples;
    p.radianceDirections = 0;
    p.seed = r.seed;
    return p;
}

struct Sums {
    double error = 0, truth = 0, change = 0, changeError = 0, area = 0, bias = 0, changeSum = 0;
};

void compare(const BakedRoom& baked, const DynamicRoom& room) {
    const DynamicObject object = room.object(0);
    const Scene posed = posedScene(baked.scene, {&object, 1});
    Progress progress;
    const auto start = Clock::now();
    const LightField truth = bake(posed, paramsOf(baked.field.record), progress);
    std::printf("new bake: %.2f s\n", 1e-3 * milliseconds(start));
    const RayScene rays(baked.scene);
    const Unwrap unwrap =
        restoreUnwrap(baked.scene, rays, baked.field.charts, baked.field.triangleCharts,
                      {baked.field.atlas.width, baked.field.atlas.height});
    const RayScene objectRays(posed);
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
        const std::uint32_t x = unwrap.texels[i] % unwrap.atlasWidth - own.x;
        const std::uint32_t y = unwrap.texels[i] / unwrap.atlasWidth - own.y;
        const double t = luminance(truth.atlas.at(other.x + x, other.y + y));
        const double s = luminance(baked.field.atlas.irradiance[unwrap.texels[i]]);
        const double d = luminance(room.irradiance().irradiance[unwrap.texels[i]]);
        // Texels under the object are of no interest.
        bool covered = false;
        const Vec3 n = own.normal;
        for (const SurfacePoint& q : unwrap.points.of(i)) {
            const Vec3 from = positionAt(baked.scene, q.triangle, q.barycentric);
            covered |= objectRays.closest({from + 1e-4f * n, n, 0, 2e-3f}).triangle != kNoTriangle;
            const Vec3 local = glm::abs(object.pose.inversePoint(from));
            covered |= maxComponent(local) < 0.51f;
        }
        if (covered) continue;
        const double a = unwrap.texelArea(i);
        const auto add = [&](Sums& sums) {
            sums.error += a * (d - t) * (d - t);
            sums.truth += a * t * t;
            sums.change += a * (t - s) * (t - s);
            sums.bias += a * (d - t);
            sums.changeSum += a * (t - s);
            sums.area += a;
        };
        add(all);
        if (n.y > 0.99f && positionAt(baked.scene, p.triangle, p.barycentric).y < 0.01f) add(floor);
        if (std::abs(t - s) > 0.02 * s) add(changed);
    }
    const auto print = [](const char* name, const Sums& s) {
        std::printf(
            "%-22s relRMSE %.3f %%  error / change %.3f  (flux: change %+.4f W, off by %+.4f)"
            "  %.2f m2\n",
            name, 100 * std::sqrt(s.error / s.truth), std::sqrt(s.error / s.change), s.changeSum,
            s.bias, s.area);
    };
    print("whole room", all);
    print("floor", floor);
    print("changed by over 2 %", changed);
    // Faces of the cube, by triangles of equal normal: mean irradiance.
    const LitObject& lit = room.litObjects()[0];
    const auto firstTriangle = static_cast<std::uint32_t>(baked.scene.triangles.size());
    for (std::uint32_t face = 0; face < lit.mesh->scene.triangles.size(); face += 2) {
        Vec3 mine(0), theirs(0);
        int count = 0;
        for (std::uint32_t k = face; k < face + 2; ++k)
            for (int i = 0; i < 20; ++i)
                for (int j = 0; i + j < 20; ++j, ++count) {
                    const Vec2 b((i + 0.33f) / 20, (j + 0.33f) / 20);
                    mine += lit.irradiance(k, b, true);
                    const std::uint32_t c = truth.triangleCharts[firstTriangle + k].front;
                    if (c == kNoChart) continue;
                    const Vec3 p = positionAt(posed, firstTriangle + k, b);
                    theirs +=
                        truth.atlas.sample(truth.charts[c], truth.charts[c].texelCoordinates(p));
                }
        const Vec3 n = geometricNormal(posed, firstTriangle + face);
        std::printf("face (%+.0f %+.0f %+.0f): E %.4f, new bake %.4f: %+.2f %%\n", n.x, n.y, n.z,
                    luminance(mine) / count, luminance(theirs) / count,
                    100 * (luminance(mine) / luminance(theirs) - 1));
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string a = argv[i];
        const auto next = [&] { return std::string(argv[++i]); };
        if (a == "--size")
            o.size = std::stof(next());
        else if (a == "--frames")
            o.frames = std::stoi(next());
        else if (a == "--shadow") {
            const std::string k = next();
            o.settings.shadow = k == "none"   ? ShadowKind::none
                                : k == "soft" ? ShadowKind::soft
                                              : ShadowKind::field;
        } else if (a == "--flat") {
            o.settings.shading = Shading::flat;
        } else if (a == "--vertices") {
            o.settings.gather.points = GatherPoints::vertices;
            o.settings.gather.subdivision = std::stoi(next());
        } else if (a == "--at") {
            const std::string text = next();
            o.placed = std::sscanf(text.c_str(), "%f,%f,%f", &o.at.x, &o.at.y, &o.at.z) == 3;
        } else
            o.file = a;
    }
    const BakedRoom baked = readField(o.file);
    if (!o.placed) o.at = boundsOf(baked.scene).centre();
    const RayScene rays(baked.scene);
    auto start = Clock::now();
    DynamicRoom room(baked.scene, rays, baked.field);
    std::printf("making ready: %.1f ms", milliseconds(start));
    room.add(makeCube(o));
    start = Clock::now();
    room.update();
    std::printf(", first update: %.1f ms\n", milliseconds(start));
    if (o.frames > 0) measureTimes(room, o);
    compare(baked, room);
}
