// Light from outside: skies over open scenes, in closed form.

#include "solved_scene.h"

#include "support/analytic_scenes.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/render/cpu/path_integrator.h"
#include "vlf/scene/generate/primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace vlf::test {
namespace {

Environment uniformSky(const Vec3& radiance) {
    Environment e;
    e.radiance = radiance;
    return e;
}

/// A picture whose pixels are what `radiance` says of their direction.
template <class Radiance>
Environment paintedSky(int height, Radiance radiance) {
    Environment e = uniformSky(Vec3(1));
    e.picture = Image(2 * height, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 2 * height; ++x) {
            const Vec2 place((static_cast<float>(x) + 0.5f) / static_cast<float>(2 * height),
                             (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
            e.picture.at(x, y) = Vec3(radiance(skyDirection(e, place)));
        }
    return e;
}

Scene plate(float albedo, const Environment& sky) {
    SceneBuilder b;
    b.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, b.material("plate", Vec3(albedo)));
    b.scene().environment = sky;
    return b.scene();
}

/// On an unoccluded surface with this normal, by the midpoint rule.
double irradianceOf(const Environment& sky, const Vec3& normal) {
    constexpr int kRows = 512;
    double sum = 0;
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < 2 * kRows; ++x) {
            const Vec2 place((static_cast<float>(x) + 0.5f) / (2 * kRows),
                             (static_cast<float>(y) + 0.5f) / kRows);
            const Vec3 d = skyDirection(sky, place);
            sum += luminance(skyRadiance(sky, d)) * std::max(0.0f, glm::dot(d, normal)) *
                   std::sin(kPi * place.y);
        }
    return sum * kPi * kPi / (double(kRows) * kRows);
}

double largestDeviation(const SolvedScene& s, const Vec3& expected) {
    double worst = 0;
    for (const Vec3& e : s.state.irradiance)
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(double(e[c]) / double(expected[c]) - 1));
    return worst;
}

constexpr Vec3 kUp{0, 1, 0};

TEST(ConstantSky, GivesALoneFloorExactlyPiTimesItsRadiance) {
    const Vec3 radiance(1, 2, 0.3f);
    const SolvedScene s(plate(1, uniformSky(radiance)), quickParams(500));
    EXPECT_GT(s.state.irradiance.size(), 400u);
    EXPECT_LT(largestDeviation(s, kPi * radiance), 2e-5);
}

TEST(ConstantSky, IsAFurnaceForConvexBodiesOfAnyAlbedo) {
    for (const float albedo : {0.2f, 0.95f}) {
        SceneBuilder b;
        b.box(Vec3(0), Vec3(1), false, b.material("box", Vec3(albedo)));
        b.scene().environment = uniformSky(Vec3(2));
        EXPECT_LT(largestDeviation(SolvedScene(b.scene(), quickParams(1500)), Vec3(2 * kPi)), 2e-5);
    }
}

TEST(ConstantSky, IsAFurnaceForWhiteBodiesOfAnyShape) {
    SceneBuilder b;
    const std::uint32_t white = b.material("white", Vec3(1));
    b.quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, white);
    b.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, white);
    b.scene().environment = uniformSky(Vec3(1));
    BakeParams p = quickParams(2000);
    p.tolerance = 1e-5;
    EXPECT_LT(largestDeviation(SolvedScene(b.scene(), p), Vec3(kPi)), 5e-3);
}

TEST(ConstantSky, LightsTheFloorOfAnOpenBoxByTheFormFactorOfTheOpening) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("black", Vec3(0)));
    b.scene().triangles.erase(b.scene().triangles.begin() + 6, b.scene().triangles.begin() + 8);
    b.scene().meshes.clear();
    b.scene().environment = uniformSky(Vec3(3));
    BakeParams p = quickParams(4000);
    p.directions = 2049;
    const SolvedScene s(b.scene(), p);
    EXPECT_NEAR(s.meanIrradianceOfChart(4) / (3 * kPi * parallelFormFactor(1)), 1, 0.005);
}

TEST(PaintedSky, LightsAFloorByItsCosineWeightedRadiance) {
    const auto tilted = glm::normalize(Vec3(0.5f, 0.6f, -0.3f));
    for (const Environment& sky :
         {paintedSky(64, [](const Vec3& d) { return std::max(0.0f, d.y); }),
          paintedSky(64, [&](const Vec3& d) { return 1 + glm::dot(d, tilted); }),
          paintedSky(128, [&](const Vec3& d) { return d.x > 0 ? 1.0f : 0.2f; }),
          paintedSky(128, [&](const Vec3& d) { return std::exp(3 * glm::dot(d, tilted)); })}) {
        const SolvedScene s(plate(0.5f, sky), quickParams(300));
        EXPECT_NEAR(s.meanIrradianceOfChart(0) / irradianceOf(sky, kUp), 1, 0.004);
    }
}

TEST(PaintedSky, TurnsWithItsOption) {
    Environment sky = paintedSky(64, [](const Vec3& d) { return std::max(0.0f, d.x); });
    SceneBuilder b;
    b.quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, b.material("wall", Vec3(0.5f)));  // faces +X
    for (const float turn : {0.0f, 180.0f, -60.0f}) {
        sky.turn = turn;
        b.scene().environment = sky;
        const SolvedScene s(b.scene(), quickParams(300));
        const double expected = irradianceOf(sky, {1, 0, 0});
        EXPECT_NEAR(s.meanIrradianceOfChart(0), expected, 0.02) << turn;  // of 2.1, the most
    }
}

/// Radiance 2000 within 1.5 degrees of a direction 35 degrees from the zenith, 0.2 elsewhere.
Environment sunnySky() {
    const Vec3 sun = glm::normalize(Vec3(std::tan(glm::radians(35.0f)), 1, 0));
    return paintedSky(512, [&](const Vec3& d) {
        return glm::dot(d, sun) > std::cos(glm::radians(1.5f)) ? 2000.0f : 0.2f;
    });
}

TEST(SunnySky, LightsAPlaneByRadianceSolidAngleAndCosine) {
    const SolvedScene s(plate(0, sunnySky()), quickParams(500));
    const double solidAngle = 2 * kPi * (1 - std::cos(glm::radians(1.5)));
    const double expected = 0.2 * kPi + (2000 - 0.2) * solidAngle * std::cos(glm::radians(35.0));
    const double painted = irradianceOf(s.scene.environment, kUp);  // pixels are coarse
    EXPECT_NEAR(painted / expected, 1, 0.02);
    EXPECT_NEAR(s.meanIrradianceOfChart(0) / painted, 1, 0.003);
    for (std::size_t i = 0; i < s.state.irradiance.size(); ++i) {
        if (s.state.unwrap.texelChart[i] != s.state.unwrap.triangleCharts[0].front) continue;
        EXPECT_NEAR(luminance(s.state.irradiance[i]) / expected, 1, 0.03);
    }
}

TEST(SunnySky, CastsTheShadowThatPathTracingSees) {
    SceneBuilder b;
    b.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, b.material("floor", Vec3(0)));
    b.quad({-0.2f, 0.6f, -0.5f}, {0.4f, 0, 0}, {0, 0, 1}, b.material("board", Vec3(0)));
    b.scene().environment = sunnySky();
    const SolvedScene s(b.scene(), quickParams(4000));
    const PathIntegrator truth(s.scene, s.state.rays);
    const double unshadowed = irradianceOf(s.scene.environment, kUp);
    int compared = 0;
    for (std::size_t i = 0; i < s.state.irradiance.size(); ++i) {
        if (s.state.unwrap.texelChart[i] != s.state.unwrap.triangleCharts[0].front) continue;
        const Vec3 p = s.centre(i);
        if (std::abs(p.z) > 0.05f) continue;
        double sum = 0;
        constexpr int kSamples = 2000;
        RandomStream random(9, i);
        const auto points = s.state.unwrap.points.of(i);
        for (int k = 0; k < kSamples; ++k) {
            const SurfacePoint& at = points[static_cast<std::size_t>(k) % points.size()];
            const auto e = truth.irradiance(
                {at.triangle, at.barycentric, true}, [](std::uint32_t, bool) { return true; },
                random);
            sum += luminance(e.value_or(Vec3(0))) / kSamples;
        }
        // Edge texels are a sample of the penumbra.
        EXPECT_NEAR(luminance(s.state.irradiance[i]), sum, 0.05 * unshadowed) << p.x;
        ++compared;
    }
    EXPECT_GT(compared, 30);
}

TEST(Outside, ItsLightIsCountedAsEmittedAndAsEscaped) {
    struct Case {
        float albedo;
        Environment sky;
    };
    for (const Case& c : {Case{0, uniformSky(Vec3(2))},
                          {1, uniformSky(Vec3(2))},
                          {0, sunnySky()},
                          {1, sunnySky()}}) {
        const SolvedScene s(plate(c.albedo, c.sky), quickParams(500));
        const EnergyReport& e = s.field.record.energy;
        const double expected = 4 * (irradianceOf(c.sky, kUp) + irradianceOf(c.sky, -kUp));
        EXPECT_NEAR(e.emitted.y / expected, 1, 0.01);
        EXPECT_NEAR(e.absorbed.y / expected, 1 - c.albedo, 0.01);
        EXPECT_NEAR(e.escaped.y / expected, c.albedo, 0.015);
    }
}

TEST(Outside, DirectionalLightIsCountedByTheScenesSilhouette) {
    Scene scene = plate(0, {});
    PunctualLight light;
    light.kind = PunctualKind::directional;
    light.direction = glm::normalize(Vec3(1, -1, 0));
    light.intensity = Vec3(3);
    scene.lights = {light};
    const SolvedScene s(scene, quickParams(300));
    const EnergyReport& e = s.field.record.energy;
    EXPECT_NEAR(e.emitted.x / (3 * 4 * std::sqrt(0.5)), 1, 0.01);
    EXPECT_NEAR(e.absorbed.x / e.emitted.x, 1, 0.01);
}

TEST(Outside, NothingOfItEntersAClosedRoom) {
    Scene scene = furnaceBox(Vec3(0.5f), Vec3(1));
    const SolvedScene dark(scene, quickParams(2000));
    scene.environment = sunnySky();
    const SolvedScene lit(scene, quickParams(2000));
    const auto inside = [](const SolvedScene& s) {
        return s.meanIrradiance([&](std::size_t i) {
            const std::uint32_t t = s.state.unwrap.points.of(i)[0].triangle;
            return s.state.unwrap.triangleCharts[t].front == s.state.unwrap.texelChart[i];
        });
    };
    EXPECT_NEAR(inside(lit) / inside(dark), 1, 2e-4);
}

TEST(Outside, ABlackEnvironmentChangesNothing) {
    Scene scene = smallCornell();
    const SolvedScene without(scene, quickParams(1000));
    scene.environment.turn = 30;
    scene.environment.picture = Image(4, 2, Vec3(1));
    const SolvedScene with(scene, quickParams(1000));
    ASSERT_EQ(with.state.irradiance.size(), without.state.irradiance.size());
    for (std::size_t i = 0; i < with.state.irradiance.size(); ++i)
        ASSERT_EQ(with.state.irradiance[i], without.state.irradiance[i]);
}

/// A ball well above a small black plate.
DynamicRoom ballUnder(const SolvedScene& s, Shading shading) {
    Material material;
    material.diffuse = Vec3(0.5f);
    DynamicObject object;
    object.name = "ball";
    object.model = std::make_shared<ObjectModel>(makePrimitive("sphere", material));
    object.pose.translation = {0, 6, 0};
    object.pose.scale = 0.3f;
    object.settings.shading = shading;
    object.settings.directSamples = 64;
    object.settings.shadow = ShadowKind::none;
    DynamicRoom room(s.scene, s.state.rays, s.field);
    room.add(object);
    room.update();
    return room;
}

/// Irradiance where the ball's normal is nearest to `normal`.
Vec3 irradianceAt(const DynamicRoom& room, const Vec3& normal) {
    const LitObject& lit = room.litObjects()[0];
    const Scene& mesh = lit.mesh->scene;
    std::uint32_t best = 0;
    float most = -1;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const float cosine = glm::dot(shadingNormalAt(mesh, t, Vec2(1.0f / 3)), normal);
        if (cosine > most) most = cosine, best = t;
    }
    return lit.irradiance(best, Vec2(1.0f / 3), true);
}

TEST(DynamicObject, IsLitByTheSky) {
    const SolvedScene s(plate(0, uniformSky({1, 2, 3})), quickParams(300));
    for (const Shading shading : {Shading::gather, Shading::prt}) {
        const DynamicRoom room = ballUnder(s, shading);
        for (const Vec3& n : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)})
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(irradianceAt(room, n)[c] / (kPi * s.scene.environment.radiance[c]), 1,
                            0.05);
    }
}

TEST(DynamicObject, IsLitByTheSunAndByPunctualLights) {
    Scene scene = plate(0, sunnySky());
    PunctualLight light;
    light.position = {3, 6, 0};
    light.intensity = Vec3(30);
    scene.lights = {light};
    const SolvedScene s(scene, quickParams(300));
    const Vec3 sun = glm::normalize(Vec3(std::tan(glm::radians(35.0f)), 1, 0));
    for (const Shading shading : {Shading::gather, Shading::prt, Shading::lights}) {
        const DynamicRoom room = ballUnder(s, shading);
        const auto expected = [&](const Vec3& n) {
            const Vec3 way = light.position - (Vec3(0, 6, 0) + 0.3f * n);
            return irradianceOf(s.scene.environment, n) +
                   30 * glm::dot(n, way) / std::pow(glm::length(way), 3.0f);
        };
        // Where the point is nearest its light has a peak narrower than the ball's texels.
        const double tolerance = shading == Shading::gather ? 0.12 : 0.25;
        for (const Vec3& n : {sun, Vec3(1, 0, 0)})
            EXPECT_NEAR(luminance(irradianceAt(room, n)) / expected(n), 1, tolerance)
                << static_cast<int>(shading) << " " << n.x;
    }
}

}  // namespace
}  // namespace vlf::test
