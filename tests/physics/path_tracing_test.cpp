// Baked irradiance against path tracing at texels spread over the scene.

#include "solved_scene.h"

#include "vlf/math/random.h"
#include "vlf/render/cpu/irradiance_error.h"
#include "vlf/scene/generate/generate.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

namespace vlf::test {

namespace {

constexpr int kTexels = 300, kSamples = 1500;

using Wanted = std::function<bool(std::size_t)>;

/// Up to kTexels of the texels wanted, spread evenly over the atlas.
std::vector<std::size_t> chooseTexels(const SolvedScene& s, const Wanted& wanted) {
    std::vector<std::size_t> candidates, chosen;
    for (std::size_t i = 0; i < s.state.unwrap.texels.size(); ++i)
        if (wanted(i)) candidates.push_back(i);
    RandomStream random(1, 2);
    for (std::size_t k = 0; k < kTexels; ++k) {
        const double place = (static_cast<double>(k) + random.next()) / kTexels;
        chosen.push_back(
            candidates[static_cast<std::size_t>(place * static_cast<double>(candidates.size()))]);
    }
    return chosen;
}

IrradianceError errorAgainstPathTracing(const SolvedScene& s, const Wanted& wanted) {
    const Unwrap& u = s.state.unwrap;
    std::vector<std::vector<SidePoint>> points;
    std::vector<Vec3> baked;
    std::vector<float> area;
    for (const std::size_t i : chooseTexels(s, wanted)) {
        std::vector<SidePoint>& places = points.emplace_back();
        for (const SurfacePoint& p : u.points.of(i))
            places.push_back(
                {p.triangle, p.barycentric, u.triangleCharts[p.triangle].front == u.texelChart[i]});
        baked.push_back(s.state.irradiance[i]);
        area.push_back(u.texelArea(i));
    }
    const auto isOpen = [&](std::uint32_t t, bool front) {
        return (front ? u.triangleCharts[t].front : u.triangleCharts[t].back) != kNoChart;
    };
    Progress progress;
    const std::vector<TexelArea> places(points.begin(), points.end());
    const auto truth =
        estimateIrradiance(s.scene, s.state.rays, places, isOpen, {kSamples, 5, {}}, progress);
    return compareIrradiance(baked, truth, area);
}

void expectAgreement(const std::string& what, const IrradianceError& e, double rmse, double bias) {
    std::printf("%s: relative RMSE %.3f %%, bias %+.3f %% (+- %.3f %%), truth's error %.3f %%\n",
                what.c_str(), 100 * e.relativeRmse, 100 * e.bias, 100 * e.biasError,
                100 * e.truthError);
    EXPECT_GT(e.texels, kTexels / 2) << what;
    // Subtracting the truth's variance leaves what that variance is itself uncertain by.
    const double uncertainty = 3 * e.truthError * e.truthError * std::sqrt(2.0 / e.texels);
    EXPECT_LT(e.relativeRmse * e.relativeRmse, rmse * rmse + uncertainty) << what;
    EXPECT_LT(std::abs(e.bias), 3 * e.biasError + bias) << what;
}

bool anywhere(std::size_t) {
    return true;
}

/// Bluish, darker towards the ground, with a small sun towards the front and the left.
Environment gradientSky() {
    Environment e;
    e.radiance = {0.8f, 1, 1.2f};
    e.picture = Image(256, 128);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x)
            e.picture.at(x, y) = Vec3(y < 64 ? 1 - 0.01f * static_cast<float>(y) : 0.15f);
    for (int y = 42; y < 44; ++y)
        for (int x = 16; x < 18; ++x) e.picture.at(x, y) = Vec3(600);
    return e;
}

BakeParams standardTransport(double texels) {
    BakeParams p = presetParams("standard");
    p.texelBudget = texels;
    return p;
}

}  // namespace

TEST(PathTracing, AgreesInTheCornellBox) {
    const SolvedScene s(generateScene("cornell"), standardTransport(20000));
    expectAgreement("cornell", errorAgainstPathTracing(s, anywhere), 0.02, 0.002);
}

TEST(PathTracing, AgreesInTwoRoomsAndInTheDarkOneApart) {
    const SolvedScene s(generateScene("two-rooms"), standardTransport(25000));
    const auto inDarkRoom = [&](std::size_t i) { return s.centre(i).x > 4.15f; };
    expectAgreement("two-rooms", errorAgainstPathTracing(s, anywhere), 0.02, 0.002);
    expectAgreement("its dark room", errorAgainstPathTracing(s, inDarkRoom), 0.05, 0.005);
}

TEST(PathTracing, AgreesInTheMirrorRoom) {
    const SolvedScene s(generateScene("mirror-room", {3000}), standardTransport(25000));
    expectAgreement("mirror-room", errorAgainstPathTracing(s, anywhere), 0.04, 0.003);
}

TEST(PathTracing, AgreesBesideRoughMirrors) {
    const SolvedScene s(generateScene("gloss"), standardTransport(15000));
    expectAgreement("gloss", errorAgainstPathTracing(s, anywhere), 0.03, 0.004);
}

TEST(PathTracing, AgreesBesideGlass) {
    const SolvedScene s(generateScene("glass"), standardTransport(6000));
    // What glass receives nobody needs.
    const auto isDiffuse = [&](std::size_t i) {
        const Chart& chart = s.state.unwrap.charts[s.state.unwrap.texelChart[i]];
        return !s.scene.materials[chart.material].isGlass();
    };
    const IrradianceError e = errorAgainstPathTracing(s, isDiffuse);
    std::printf("glass: relative RMSE %.3f %%, bias %+.3f %% (+- %.3f %%), truth's error %.3f %%\n",
                100 * e.relativeRmse, 100 * e.bias, 100 * e.biasError, 100 * e.truthError);
    EXPECT_LT(std::abs(e.bias), 3 * e.biasError + 0.005);
}

TEST(PathTracing, AgreesByTheCaustics) {
    const SolvedScene s(generateScene("caustic"), standardTransport(25000));
    const IrradianceError e = errorAgainstPathTracing(s, anywhere);
    std::printf("caustic: relative RMSE %.3f %%, bias %+.3f %% (+- %.3f %%)\n",
                100 * e.relativeRmse, 100 * e.bias, 100 * e.biasError);
    EXPECT_LT(std::abs(e.bias), 3 * e.biasError + 0.01);
}

TEST(PathTracing, AgreesUnderASkyWithASunThroughAnOpenFront) {
    Scene scene = smallCornell();
    scene.environment = gradientSky();
    const SolvedScene s(scene, standardTransport(20000));
    expectAgreement("open front", errorAgainstPathTracing(s, anywhere), 0.03, 0.004);
}

TEST(PathTracing, AgreesUnderPunctualLights) {
    Scene scene = smallCornell();
    for (Material& m : scene.materials) m.emission = Vec3(0);
    PunctualLight light;
    light.position = {0.3f, 0.8f, 0.4f};
    light.intensity = {1, 2, 3};
    scene.lights.push_back(light);
    light.kind = PunctualKind::spot;
    light.position = {0.5f, 0.5f, 2};
    light.direction = glm::normalize(Vec3(0.2f, -0.3f, -1));
    light.innerCone = 0.1f;
    light.outerCone = 0.35f;
    light.intensity = Vec3(20);
    scene.lights.push_back(light);
    light.kind = PunctualKind::directional;
    light.direction = glm::normalize(Vec3(-0.4f, -0.5f, -1));
    light.intensity = {4, 3, 2};
    scene.lights.push_back(light);
    const SolvedScene s(scene, standardTransport(20000));
    expectAgreement("punctual", errorAgainstPathTracing(s, anywhere), 0.03, 0.004);
}

TEST(PathTracing, AgreesBesideRoughMirrorsUnderASkyWithASunAndAPoint) {
    SceneBuilder b;
    b.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, b.material("floor", Vec3(0.6f)));
    b.quad({-1, 0, -1}, {2, 0, 0}, {0, 1, 0}, b.material("rough", Vec3(0.1f), Vec3(0), Vec3(0.7f)));
    b.scene().materials.back().roughness = 0.3f;
    b.scene().environment = gradientSky();
    PunctualLight light;
    light.position = {0.4f, 0.6f, 0.3f};
    light.intensity = Vec3(0.5f);
    b.scene().lights.push_back(light);
    BakeParams p = standardTransport(8000);
    p.glossDirections = 0;
    const SolvedScene s(b.scene(), p);
    const auto onFloor = [&](std::size_t i) {
        return s.state.unwrap.texelChart[i] == s.state.unwrap.triangleCharts[0].front;
    };
    expectAgreement("rough mirror outside", errorAgainstPathTracing(s, onFloor), 0.03, 0.004);
}

TEST(PathTracing, AgreesOnARoundBodyOfFewFacets) {
    // Facets much larger than texels: irradiance follows the shading normal across each.
    SceneBuilder b;
    b.box({0, 0, 0}, {3, 3, 3}, true, b.material("wall", Vec3(0.7f, 0.6f, 0.5f)));
    b.quad({1, 2.99f, 1}, {1, 0, 0}, {0, 0, 1}, b.material("lamp", Vec3(0), Vec3(10)));
    const std::size_t facets = b.scene().triangles.size();
    b.sphere({1.5f, 1.2f, 1.5f}, 0.6f, 1, false, b.material("ball", Vec3(0.5f)));
    const SolvedScene s(b.scene(), standardTransport(25000));
    const auto onBall = [&](std::size_t i) {
        return s.state.unwrap.points.of(i)[0].triangle >= facets;
    };
    expectAgreement("ball of 80 facets", errorAgainstPathTracing(s, onBall), 0.02, 0.003);
}

}  // namespace vlf::test
