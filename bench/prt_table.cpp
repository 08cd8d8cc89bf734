// Precomputed transfer of a knot in a room: what it takes, and how far it is from the truth by
// order: prt_table [--room NAME] [--preset NAME] [--size METRES] [--paths N]

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/dynamic/incident_light.h"
#include "vlf/dynamic/object_model.h"
#include "vlf/dynamic/point_lights.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/propagate/bake.h"
#include "vlf/render/cpu/path_integrator.h"
#include "vlf/scene/generate/generate.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace vlf;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kObjects = 50;
constexpr std::uint32_t kSteps = 7;  // every so many triangles are measured

struct Options {
    std::string room = "cornell", preset = "draft";
    float size = 0.25f;
    int paths = 2048;
};

/// Least milliseconds of several runs.
template <class Work>
double milliseconds(int runs, Work work) {
    double least = 1e30;
    for (int i = 0; i < runs; ++i) {
        const Clock::time_point start = Clock::now();
        work();
        least = std::min(least,
                         std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    return least;
}

struct Room {
    Scene scene;
    RayScene rays;
    LightField field;
    RoomTexels texels;
    std::vector<Vec3> radiance;

    explicit Room(const Options& options)
        : scene(generateScene(options.room)),
          rays(scene),
          field(baked(scene, options.preset)),
          texels(makeRoomTexels(scene, rays, field)),
          radiance(texels.unwrap.atlasSize(), Vec3(0)) {
        for (const std::uint32_t t : texels.unwrap.texels)
            radiance[t] = texels.reflectance[t] * field.atlas.irradiance[t] / kPi;
    }
    static LightField baked(const Scene& scene, const std::string& preset) {
        Progress progress;
        return bake(scene, presetParams(preset), progress);
    }
};

std::shared_ptr<const ObjectModel> knot() {
    Material material;
    material.diffuse = {0.8f, 0.7f, 0.6f};
    return std::make_shared<const ObjectModel>(makePrimitive("knot", material));
}

struct Place {
    const char* name;
    Pose pose;
};

/// As parts of the room's box: in the middle, on the floor, and beside a wall.
std::vector<Place> places(const Scene& scene, float size) {
    const Bounds box = boundsOf(scene);
    const Vec3 s = box.size();
    const auto at = [&](float x, float y, float z) {
        return Pose{box.lower + Vec3(x, y, z) * s, glm::angleAxis(0.5f, Vec3(0, 1, 0)), size};
    };
    const float half = 0.55f * size;
    return {{"in the middle", at(0.5f, 0.5f, 0.5f)},
            {"on the floor", at(0.35f, half / s.y, 0.6f)},
            {"at the wall", at(half / s.x, 0.4f, 0.5f)}};
}

void printTimes(const Room& room, const ObjectMesh& mesh, float size) {
    std::printf("knot: %zu triangles, %zu vertices\n", mesh.scene.triangles.size(),
                mesh.sidedVertexCount());
    for (const bool reflections : {false, true})
        std::printf("transfer, %s: %.0f ms\n", reflections ? "with reflections" : "shadows alone",
                    milliseconds(3, [&] { computeTransfer(mesh, {.reflections = reflections}); }));
    const IncidentLightFinder finder(room.scene, room.rays, room.texels);
    IncidentLightFinder::Scratch scratch(finder);
    IncidentLight light;
    const Bounds box = boundsOf(mesh.scene);
    for (const float scale : {0.05f * size, size}) {
        const Pose pose = places(room.scene, scale)[0].pose;
        const double one =
            milliseconds(200, [&] { finder.find(box, pose, room.radiance, {}, scratch, light); });
        std::printf("incident light, %s: %.3f ms\n", light.uniform ? "one place" : "eight corners",
                    one);
    }
    const std::vector<PrtTransfer> transfers(kObjects, computeTransfer(mesh, {}));
    std::vector<std::vector<Vec3>> irradiance(kObjects, std::vector<Vec3>(mesh.sidedVertexCount()));
    for (const bool uniform : {true, false}) {
        light.uniform = uniform;
        const double all = milliseconds(50, [&] {
            parallelFor(kObjects,
                        [&](std::size_t i) { applyTransfer(transfers[i], light, irradiance[i]); });
        });
        std::printf("%zu objects, %s: %.2f ms on %d threads (%.1f MB of transfer each)\n", kObjects,
                    uniform ? "one place" : "eight corners", all, threadCount(),
                    transfers[0].blocks.size() * 4e-6);
    }
}

/// Irradiance close to the first corner of a triangle, and the square of its standard error.
struct Truth {
    std::uint32_t vertex = 0;
    Vec3 field{0}, fieldError{0};  // by paths that end on the room as it is baked, without the knot
    Vec3 indirect{0}, indirectError{0};  // of these, without what the emitters send at once
    Vec3 traced{0}, tracedError{0};      // by paths in the room with the knot in it
};

struct Mean {
    glm::dvec3 sum{0}, squares{0};
    int count = 0;

    void add(const Vec3& v) {
        sum += glm::dvec3(v);
        squares += glm::dvec3(v) * glm::dvec3(v);
        ++count;
    }
    Vec3 mean() const { return Vec3(sum / static_cast<double>(count)); }
    Vec3 squareError() const {
        const glm::dvec3 m = sum / static_cast<double>(count);
        return Vec3((squares / static_cast<double>(count) - m * m) / static_cast<double>(count));
    }
};

struct Seen {
    Vec3 reflected{0}, emitted{0};
};

/// What comes along a ray from the room or, by diffuse reflection, from the knot.
Seen fieldPath(const Room& room, const ObjectMesh& mesh, const Pose& pose, SightTracer& tracer,
               Ray ray, RandomStream& random) {
    Vec3 throughput(1);
    for (int bounces = 0; bounces < 20; ++bounces) {
        const Ray local{pose.inversePoint(ray.origin),
                        pose.inverseDirection(ray.direction) / pose.scale};
        const Hit hit = mesh.rays.closest(local);
        if (!hit || room.rays.occluded({ray.origin, ray.direction, 0, hit.t})) break;
        const Vec3 normal = pose.direction(geometricNormal(mesh.scene, hit.triangle));
        throughput *= mesh.scene.material(hit.triangle).diffuse;
        ray.origin += hit.t * ray.direction + room.rays.epsilon() * normal;
        ray.direction = frameFromNormal(normal).toWorld(sampleCosineHemisphere(random.next2()));
    }
    Seen seen;
    thread_local Sights sights;
    tracer.trace(std::span(&ray, 1), sights);
    if (sights.texel[0] != kNoTexel) seen.reflected = throughput * room.radiance[sights.texel[0]];
    for (const Sight& sight : sights.others) {
        const Vec3 share = throughput * sight.throughput;
        seen.reflected += share * diffuseRadiance(sight, room.radiance, {});
        seen.emitted += share * sight.emission;
    }
    return seen;
}

std::vector<Truth> findTruth(const Room& room, const std::shared_ptr<const ObjectModel>& model,
                             const Pose& pose, int paths) {
    DynamicObject object;
    object.model = model;
    object.pose = pose;
    const Scene scene = posedScene(room.scene, std::span(&object, 1));
    const RayScene rays(scene);
    const PathIntegrator integrator(scene, rays);
    const ObjectMesh& mesh = model->mesh();
    const auto first = static_cast<std::uint32_t>(room.scene.triangles.size());
    std::vector<Truth> truths(mesh.scene.triangles.size() / kSteps);
    parallelFor(truths.size(), 8, [&](std::size_t i) {
        const auto triangle = static_cast<std::uint32_t>(i) * kSteps;
        const Vec2 place(1.0f / 192);
        const SidePoint point{first + triangle, place, true};
        const Vec3 normal =
            pose.direction(mesh.scene.normals[mesh.scene.triangles[triangle].vertex[0]]);
        const Vec3 face = geometricNormal(scene, point.triangle);
        const Vec3 from = positionAt(scene, point.triangle, place) + rays.epsilon() * face;
        SightTracer tracer(room.scene, room.rays, room.texels);
        Mean field, indirect, traced;
        for (int k = 0; k < paths; ++k) {
            RandomStream random(k, i);
            const auto everywhere = [](std::uint32_t, bool) { return true; };
            if (const auto e = integrator.irradiance(point, everywhere, random)) traced.add(*e);
            const Vec3 d = frameFromNormal(normal).toWorld(sampleCosineHemisphere(random.next2()));
            if (glm::dot(d, face) <= 0) continue;
            const Seen seen = fieldPath(room, mesh, pose, tracer, {from, d}, random);
            field.add(kPi * (seen.reflected + seen.emitted));
            indirect.add(kPi * seen.reflected);
        }
        truths[i] = {mesh.scene.triangles[triangle].vertex[0],
                     field.mean(),
                     field.squareError(),
                     indirect.mean(),
                     indirect.squareError(),
                     traced.mean(),
                     traced.squareError()};
    });
    return truths;
}

/// √(Σ(E−E*)² / ΣE*²), the truth's own noise taken out.
double relativeError(const std::vector<Truth>& truths, const std::vector<Vec3>& irradiance,
                     Vec3 Truth::*truth, Vec3 Truth::*noise) {
    double squares = 0, sum = 0;
    for (const Truth& t : truths) {
        const Vec3 d = irradiance[t.vertex] - t.*truth;
        squares += glm::dot(d, d) - glm::dot(t.*noise, Vec3(1));
        sum += glm::dot(t.*truth, t.*truth) - glm::dot(t.*noise, Vec3(1));
    }
    return std::sqrt(std::max(squares, 0.0) / sum);
}

void printErrors(const Room& room, const std::shared_ptr<const ObjectModel>& model,
                 const Options& options) {
    const ObjectMesh& mesh = model->mesh();
    const Bounds box = boundsOf(mesh.scene);
    std::vector<PrtTransfer> transfers;
    for (int order = 1; order <= kMaxShOrder; ++order)
        transfers.push_back(computeTransfer(mesh, {.order = order}));
    struct Way {
        const char* name;
        IncidentSettings settings;
        int firstOrder;
    };
    const Way ways[]{{"eight corners", {}, 1},
                     {"one place", {.largeFrom = 10}, 5},
                     {"eight, 513 lines", {.cornerLines = 513, .cornerEmitterPoints = 256}, 5}};
    const PointLighting lights =
        estimatePointLights(room.scene, room.rays, room.texels, room.field.atlas);
    std::printf("\n%-14s %-16s %6s %14s %14s %14s\n", "place", "incident light", "order",
                "field as it is", "indirect alone", "path tracing");
    for (const Place& place : places(room.scene, options.size)) {
        const std::vector<Truth> truths = findTruth(room, model, place.pose, options.paths);
        std::vector<Vec3> shaded(mesh.sidedVertexCount());
        const double time =
            milliseconds(5, [&] { shadeByLights(lights, mesh, place.pose, room.rays, shaded); });
        std::printf("%-14s %zu point light(s), %.2f ms %33.1f %%\n", place.name,
                    lights.lights.size(), time,
                    100 * relativeError(truths, shaded, &Truth::traced, &Truth::tracedError));
        for (const Way& way : ways) {
            const auto light = [&](IncidentEmitters emitters, int order) {
                IncidentSettings settings = way.settings;
                settings.emitters = emitters;
                const IncidentLightFinder finder(room.scene, room.rays, room.texels, settings);
                IncidentLightFinder::Scratch scratch(finder);
                IncidentLight incident;
                finder.find(box, place.pose, room.radiance, {}, scratch, incident);
                std::vector<Vec3> irradiance(mesh.sidedVertexCount());
                applyTransfer(transfers[static_cast<std::size_t>(order - 1)], incident, irradiance);
                return irradiance;
            };
            for (int order = way.firstOrder; order <= kMaxShOrder; ++order) {
                const std::vector<Vec3> all = light(IncidentEmitters::sampled, order);
                const std::vector<Vec3> indirect = light(IncidentEmitters::none, order);
                std::printf(
                    "%-14s %-16s %6d %12.1f %% %12.1f %% %12.1f %%\n", place.name, way.name, order,
                    100 * relativeError(truths, all, &Truth::field, &Truth::fieldError),
                    100 * relativeError(truths, indirect, &Truth::indirect, &Truth::indirectError),
                    100 * relativeError(truths, all, &Truth::traced, &Truth::tracedError));
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("What precomputed transfer takes, and its error");
    app.add_option("--room", options.room, "Example scene");
    app.add_option("--preset", options.preset, "draft, standard or high");
    app.add_option("--size", options.size, "Of the knot, metres");
    app.add_option("--paths", options.paths, "Per vertex measured");
    CLI11_PARSE(app, argc, argv);
    try {
        const Room room(options);
        const std::shared_ptr<const ObjectModel> model = knot();
        printTimes(room, model->mesh(), options.size);
        printErrors(room, model, options);
    } catch (const Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
    return 0;
}
