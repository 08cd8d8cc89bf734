// Glass in closed scenes whose light is known, and panes before lamps.

#include "solved_scene.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/render/cpu/field_shader.h"
#include "vlf/render/cpu/path_integrator.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vlf::test {

namespace {

struct Glass {
    float ior = 1.5f;
    bool thin = true;
    Vec3 transmission{1};
};

std::uint32_t addGlass(SceneBuilder& b, const Glass& glass) {
    const std::uint32_t m = b.material("glass", Vec3(0));
    b.scene().materials[m].transmission = glass.transmission;
    b.scene().materials[m].ior = glass.ior;
    b.scene().materials[m].thin = glass.thin;
    return m;
}

/// A white furnace of radiance 2 with two panes that nearly touch, a ball and a hollow ball in it.
Scene glassFurnace() {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", Vec3(0.5f), Vec3(1)));
    const std::uint32_t pane = addGlass(b, {}), solid = addGlass(b, {1.5f, false});
    b.quad({0.2f, 0.1f, 0.3f}, {0.5f, 0, 0.1f}, {0, 0.4f, 0}, pane);
    b.quad({0.2f, 0.1f, 0.305f}, {0.5f, 0, 0.1f}, {0, 0.4f, 0}, pane);
    b.sphere({0.3f, 0.7f, 0.6f}, 0.15f, 2, false, solid);
    b.sphere({0.7f, 0.3f, 0.7f}, 0.2f, 2, false, solid);
    b.sphere({0.7f, 0.3f, 0.7f}, 0.15f, 2, true, solid);
    return b.scene();
}

/// A small black floor, mesh 0, a lamp 2 m above it and, if wanted, a pane between.
Scene lampAbove(bool pane, const Glass& glass) {
    SceneBuilder b;
    const std::uint32_t black = b.material("black", Vec3(0));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(10));
    b.quad({-0.1f, 0, -0.1f}, {0, 0, 0.2f}, {0.2f, 0, 0}, black);
    b.quad({-0.1f, 2, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}, lamp);
    const std::uint32_t m = addGlass(b, glass);
    if (pane) b.quad({-0.5f, 1, -0.5f}, {0, 0, 1}, {1, 0, 0}, m);
    return b.scene();
}

}  // namespace

TEST(GlassFurnace, ShowsThePathTracerNothing) {
    const Scene scene = glassFurnace();
    const RayScene rays(scene);
    for (const bool sampleEmitters : {true, false}) {
        const PathIntegrator integrator(scene, rays, {0, sampleEmitters});
        RandomStream random(1, sampleEmitters);
        double sum = 0, squares = 0;
        constexpr int kPaths = 20000;
        for (int i = 0; i < kPaths; ++i) {
            const Vec3 origin(0.5f, 0.5f, 0.12f);
            const double l =
                integrator.radiance({origin, sampleUniformSphere(random.next2())}, random).x;
            sum += l;
            squares += l * l;
        }
        const double mean = sum / kPaths;
        const double error = std::sqrt((squares / kPaths - mean * mean) / kPaths);
        EXPECT_NEAR(mean, 2, 4 * error + 1e-4) << sampleEmitters;
        EXPECT_LT(error, 0.02);
    }
}

TEST(GlassFurnace, LeavesTheBakedWallsAsTheyAre) {
    BakeParams p = quickParams(3000);
    p.directions = 513;
    const SolvedScene s(glassFurnace(), p);
    const auto onWall = [&](std::size_t i) {
        return !s.scene.materials[s.state.unwrap.charts[s.state.unwrap.texelChart[i]].material]
                    .isGlass();
    };
    EXPECT_NEAR(s.meanIrradiance(onWall) / (2 * kPi), 1, 5e-3);
}

TEST(GlassFurnace, IsSeenThroughGlassAsItIs) {
    BakeParams p = quickParams(3000);
    p.radianceDirections = 129;
    p.radianceCells = 64;
    const SolvedScene s(glassFurnace(), p);
    std::vector<Ray> rays;
    RandomStream random(3, 4);
    for (int i = 0; i < 4000; ++i)
        rays.push_back({{0.5f, 0.5f, 0.12f}, sampleUniformSphere(random.next2())});
    for (const MirrorMethod method : {MirrorMethod::traced, MirrorMethod::lookedUp}) {
        const FieldShader shader(s.scene, s.state.rays, s.field, method);
        std::vector<Vec3> radiance(rays.size());
        shader.radiance(rays, radiance);
        double sum = 0;
        for (const Vec3& l : radiance) sum += l.x;
        // What weak branches carry is lost.
        EXPECT_NEAR(sum / static_cast<double>(rays.size()) / 2, 1, 0.02);
    }
}

TEST(Pane, TakesItsShareOfDirectLight) {
    for (const Glass& glass : {Glass{1.5f}, Glass{2.0f, true, Vec3(0.5f)}}) {
        BakeParams p = quickParams(2000);
        p.directSamples = 32;
        const SolvedScene clear(lampAbove(false, glass), p), behind(lampAbove(true, glass), p);
        const double share = (1 - paneReflectance(1, glass.ior)) * glass.transmission.x;
        const double ratio = behind.meanIrradianceOfChart(0) / clear.meanIrradianceOfChart(0);
        EXPECT_NEAR(ratio / share, 1, 3e-3) << glass.ior;
    }
}

TEST(Pane, GivesThePathTracerTheSameLightWhetherOrNotLampsAreSampled) {
    const Scene scene = lampAbove(true, {1.5f, true, Vec3(0.8f)});
    const RayScene rays(scene);
    double irradiance[2], error[2];
    for (const bool sampled : {false, true}) {
        const PathIntegrator integrator(scene, rays, {0, sampled});
        RandomStream random(5, 6);
        double sum = 0, squares = 0;
        const int paths = sampled ? 4000 : 1'000'000;
        for (int i = 0; i < paths; ++i) {
            const double e =
                integrator
                    .irradiance(
                        {0, Vec2(0.3f), true}, [](std::uint32_t, bool) { return true; }, random)
                    ->x;
            sum += e;
            squares += e * e;
        }
        irradiance[sampled] = sum / paths;
        error[sampled] =
            std::sqrt((squares / paths - irradiance[sampled] * irradiance[sampled]) / paths);
    }
    EXPECT_NEAR(irradiance[0], irradiance[1], 4 * std::hypot(error[0], error[1]));
    EXPECT_LT(error[0] / irradiance[0], 0.05);
}

TEST(Glass, LosesInTheEnergyReportWhatItsTintTakes) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", Vec3(0.6f), Vec3(1)));
    b.quad({0.2f, 0.1f, 0.4f}, {0.6f, 0, 0}, {0, 0.8f, 0}, addGlass(b, {1.5f, true, Vec3(0.4f)}));
    BakeParams p = quickParams(4000);
    p.tolerance = 1e-4;
    SolvedScene s(b.scene(), p);
    const EnergyReport& e = s.state.report.energy;
    EXPECT_NEAR((e.absorbed.x + e.unshot.x) / e.emitted.x, 1, 0.01);
}

}  // namespace vlf::test
