// White furnaces: in a closed room whose walls all emit Le and reflect ρ, the radiance is
// Le / (1 - ρ) everywhere and in every direction.

#include "solved_scene.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vlf::test {

namespace {

struct Deviation {
    double mean = 0, worst = 0;  // relative to π Le / (1 - ρ)
};

Deviation deviation(const SolvedScene& s, double expected) {
    const double mean = s.meanIrradiance([](std::size_t) { return true; });
    Deviation d{mean / expected - 1, 0};
    for (const Vec3& e : s.state.irradiance)
        d.worst = std::max(d.worst, std::abs(luminance(e) / expected - 1));
    return d;
}

/// Solved for itself, by default until next to no light is missing.
Deviation furnace(const Scene& scene, double radiance, double tolerance = 1e-6, int cells = 128) {
    BakeParams p = quickParams(2000);
    p.cells = p.coarseCells = cells;
    p.tolerance = tolerance;
    const SolvedScene s(scene, p);
    const Deviation d = deviation(s, kPi * radiance);
    ::testing::Test::RecordProperty("mean", std::to_string(d.mean));
    ::testing::Test::RecordProperty("worst", std::to_string(d.worst));
    return d;
}

}  // namespace

TEST(WhiteFurnace, OfABoxIsExact) {
    const Deviation d = furnace(furnaceBox(Vec3(0.5f), Vec3(1)), 2);
    EXPECT_LT(std::abs(d.mean), 1e-4);
    EXPECT_LT(d.worst, 2e-3);
}

TEST(WhiteFurnace, OfABrightBoxIsExact) {
    const Deviation d = furnace(furnaceBox(Vec3(0.9f), Vec3(1)), 10);
    EXPECT_LT(std::abs(d.mean), 2e-4);
    EXPECT_LT(d.worst, 5e-3);
}

TEST(WhiteFurnace, HoldsInEveryChannel) {
    BakeParams p = quickParams(2000);
    p.cells = 128;
    p.tolerance = 1e-6;
    const Vec3 albedo(0.2f, 0.5f, 0.8f), emission(3, 2, 1);
    const SolvedScene s(furnaceBox(albedo, emission), p);
    const Vec3 expected = kPi * furnaceRadiance(albedo, emission);
    glm::dvec3 sum(0);
    for (const Vec3& e : s.state.irradiance) sum += glm::dvec3(e);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c] / static_cast<double>(s.state.irradiance.size()) / expected[c], 1, 5e-4);
}

TEST(WhiteFurnace, OfASphere) {
    const Deviation d = furnace(furnaceSphere(Vec3(0.5f), Vec3(1)), 2);
    EXPECT_LT(std::abs(d.mean), 5e-3);
}

TEST(WhiteFurnace, OfWallsThatAreMirrorsInPart) {
    for (const auto& [diffuse, mirror] : {std::pair{0.3f, 0.3f}, {0.4f, 0.1f}}) {
        const Scene scene = furnaceMirrorBox(Vec3(diffuse), Vec3(mirror), Vec3(1));
        const Deviation d = furnace(scene, 1 / (1 - diffuse - mirror), 5e-3, 16);
        EXPECT_LT(std::abs(d.mean), 1e-2) << diffuse << " diffuse, " << mirror << " mirror";
    }
}

TEST(ClosedCavity, ConvergesToItsSeries) {
    // The tolerance a bake of this preset works with, not a finer one.
    for (const auto& [albedo, bound] : {std::pair{0.5f, 0.002}, {0.9f, 0.01}}) {
        BakeParams p = quickParams(2000);
        p.tolerance = presetParams("standard").tolerance;
        const SolvedScene s(furnaceBox(Vec3(albedo), Vec3(1)), p);
        EXPECT_LT(std::abs(deviation(s, kPi / (1 - albedo)).mean), bound) << "albedo " << albedo;
    }
}

TEST(ClosedCavity, AbsorbsWhatItEmits) {
    BakeParams p = quickParams(2000);
    p.tolerance = 1e-5;
    const SolvedScene s(furnaceBox(Vec3(0.7f), Vec3(1)), p);
    const EnergyReport& e = s.field.record.energy;
    EXPECT_NEAR(e.emitted.x, 6 * kPi, 1e-4);
    EXPECT_NEAR(e.absorbed.x / e.emitted.x, 1, 1e-3);
}

}  // namespace vlf::test
