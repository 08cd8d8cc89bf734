#include "vlf/scene/sky.h"

#include "support/chi_square.h"
#include "vlf/base/error.h"
#include "vlf/image/image_io.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/light_beam.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// Dim, with a wide gradient, a few bright pixels, one at the seam, one at a pole.
Environment spottedSky() {
    Environment e;
    e.radiance = {2, 1, 0.5f};
    e.turn = 33;
    e.picture = Image(32, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            e.picture.at(x, y) = Vec3(0.1f + 0.02f * static_cast<float>(y));
    e.picture.at(0, 7) = {40, 30, 20};
    e.picture.at(13, 0) = Vec3(25);
    e.picture.at(20, 11) = {5, 50, 5};
    e.picture.at(21, 11) = Vec3(9);
    return e;
}

Environment uniformSky(const Vec3& radiance) {
    Environment e;
    e.radiance = radiance;
    return e;
}

Vec3 randomDirection(RandomStream& random) {
    return sampleUniformSphere(random.next2());
}

TEST(Environment, ShowsItsPictureTheRightWayRound) {
    Environment e = uniformSky(Vec3(1));
    e.picture = Image(4, 2);
    e.picture.at(0, 0) = {1, 0, 0};  // left half of the back, above
    const auto near = [&](const Vec3& d, const Vec2& place) {
        EXPECT_LT(glm::distance(skyCoordinates(e, glm::normalize(d)), place), 1e-5f);
        EXPECT_LT(glm::distance(skyDirection(e, place), glm::normalize(d)), 1e-5f);
    };
    near({0, 0, -1}, {0.5f, 0.5f});
    near({1, 0, 0}, {0.75f, 0.5f});
    near({-1, 0, 0}, {0.25f, 0.5f});
    near({1, 1, -1}, {0.625f, 0.5f - std::asin(1 / std::sqrt(3.0f)) / kPi});
    EXPECT_LT(skyCoordinates(e, {0, 1, 0}).y, 1e-5f);
    e.turn = 90;  // counter-clockwise: the middle now lies towards -X
    near({-1, 0, 0}, {0.5f, 0.5f});
    near({0, 0, -1}, {0.75f, 0.5f});
}

TEST(Environment, GoesOnAcrossItsSeam) {
    const Environment e = spottedSky();
    const Vec3 left = skyDirection(e, {1e-5f, 0.47f}), right = skyDirection(e, {0.99999f, 0.47f});
    EXPECT_LT(glm::distance(skyRadiance(e, left), skyRadiance(e, right)),
              0.01f * glm::length(skyRadiance(e, left)));
}

TEST(Sky, IsTheSumOfItsParts) {
    const Environment e = spottedSky();
    const Sky sky(e, smoothCap(e));
    ASSERT_TRUE(sky.hasBright());
    RandomStream random(1, 2);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 d = randomDirection(random);
        EXPECT_LE(luminance(sky.smooth(d)), 1.001f * smoothCap(e));
        EXPECT_LT(glm::distance(sky.smooth(d) + sky.bright(d), skyRadiance(e, d)),
                  1e-4f * glm::length(skyRadiance(e, d)));
    }
}

TEST(Sky, DrawsDirectionsWithTheDensityThatItTells) {
    const Environment e = spottedSky();
    const Sky sky(e, smoothCap(e));
    constexpr int kColumns = 16, kRows = 8, kDraws = 200000, kInside = 40;
    std::vector<double> observed(kColumns * kRows, 0), expected(kColumns * kRows, 0);
    RandomStream random(3, 4);
    for (int i = 0; i < kDraws; ++i) {
        const Sky::Sample s = sky.sample(random.next2());
        EXPECT_NEAR(s.density, sky.density(s.direction), 0.02f * s.density + 0.02f);
        const Vec2 at = skyCoordinates(e, s.direction);
        const int x = std::min(static_cast<int>(at.x * kColumns), kColumns - 1);
        const int y = std::min(static_cast<int>(at.y * kRows), kRows - 1);
        ++observed[static_cast<std::size_t>(y * kColumns + x)];
    }
    double sum = 0;
    for (int y = 0; y < kRows * kInside; ++y)
        for (int x = 0; x < kColumns * kInside; ++x) {
            const Vec2 at((static_cast<float>(x) + 0.5f) / (kColumns * kInside),
                          (static_cast<float>(y) + 0.5f) / (kRows * kInside));
            const double solidAngle =
                2 * kPi * kPi * std::sin(kPi * at.y) / (kColumns * kInside * kRows * kInside);
            const double share = sky.density(skyDirection(e, at)) * solidAngle;
            expected[static_cast<std::size_t>(y / kInside * kColumns + x / kInside)] +=
                share * kDraws;
            sum += share;
        }
    EXPECT_NEAR(sum, 1, 2e-3);
    std::vector<double> seen, due;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < 5) continue;
        seen.push_back(observed[i]);
        due.push_back(expected[i]);
    }
    ASSERT_GT(seen.size(), 8u);
    EXPECT_LT(test::chiSquareDeviation(seen, due), 4);
}

TEST(Sky, IsSampledWithoutBias) {
    const Environment e = spottedSky();
    const Sky sky(e, smoothCap(e));
    glm::dvec3 sum(0);
    constexpr std::uint32_t kDraws = 20000;
    for (std::uint32_t i = 0; i < kDraws; ++i) {
        const Sky::Sample s = sky.sample(r2Point(i, Vec2(0.5f)));
        sum += glm::dvec3(s.bright) / static_cast<double>(s.density) / double(kDraws);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / sky.brightFlux()[c], 1, 0.01);
}

TEST(Sky, LeavesNothingBrightInASkyThatIsSmooth) {
    for (Environment e : {uniformSky(Vec3(3)), uniformSky(Vec3(1))}) {
        if (luminance(e.radiance) < 2) {  // light above, dark below
            e.picture = Image(64, 32, Vec3(1));
            for (int y = 16; y < 32; ++y)
                for (int x = 0; x < 64; ++x) e.picture.at(x, y) = Vec3(0);
        }
        EXPECT_FALSE(Sky(e, smoothCap(e)).hasBright());
    }
}

TEST(Sky, LeavesNothingSmoothWhereLampsAreAllThereIs) {
    Environment e = uniformSky(Vec3(1));
    e.picture = Image(256, 128);
    for (int y = 30; y < 36; ++y)
        for (int x = 100; x < 112; ++x) e.picture.at(x, y) = Vec3(100);
    const Sky sky(e, smoothCap(e));
    EXPECT_EQ(smoothCap(e), 0);
    EXPECT_TRUE(sky.hasBright());
    EXPECT_EQ(sky.smooth(skyDirection(e, {0.41f, 0.25f})), Vec3(0));
    const Vec3 middle = skyDirection(e, {106.0f / 256, 33.0f / 128});
    const float reach = std::acos(sky.brightCosine(middle));
    EXPECT_GT(reach, 0.12f);
    EXPECT_LT(reach, 0.25f);
}

TEST(Environment, IsRefusedWhereItIsNone) {
    const auto folder = std::filesystem::temp_directory_path() / "vlf-environment";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / "sky.exr").string();
    const auto errorOf = [&](const Image& picture) {
        writeExr(path, picture);
        try {
            readEnvironment(path);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_NE(errorOf(Image(4, 4, Vec3(1))).find("twice as wide as high"), std::string::npos);
    Image broken(4, 2, Vec3(1));
    broken.at(3, 1).y = std::nanf("");
    EXPECT_NE(errorOf(broken).find("pixel 3, 1"), std::string::npos);
    broken.at(3, 1).y = std::numeric_limits<float>::infinity();
    EXPECT_NE(errorOf(broken).find("pixel 3, 1"), std::string::npos);
    broken.at(3, 1).y = -0.25f;
    EXPECT_EQ(errorOf(broken), "");
    EXPECT_EQ(readEnvironment(path).picture.at(3, 1), Vec3(1, 0, 1));
    std::filesystem::remove_all(folder);
}

PunctualLight spot(float inner, float outer) {
    PunctualLight light;
    light.kind = PunctualKind::spot;
    light.intensity = Vec3(3);
    light.innerCone = inner;
    light.outerCone = outer;
    return light;
}

TEST(LightBeam, OfASpotFallsOffBetweenItsCones) {
    const PunctualLight light = spot(0.3f, 0.6f);
    EXPECT_EQ(coneFactor(light, std::cos(0.29f)), 1);
    EXPECT_EQ(coneFactor(light, std::cos(0.61f)), 0);
    const float half = 0.5f * (std::cos(0.3f) + std::cos(0.6f));
    EXPECT_NEAR(coneFactor(light, half), 0.25f, 1e-5f);
    const LightBeam beam = beamOf(light, {0, 0, -2}, 1e-4f);
    EXPECT_NEAR(beam.irradiance.x, 0.75f, 1e-5f);
    EXPECT_EQ(beam.toLight, Vec3(0, 0, 1));
}

TEST(LightBeam, CarriesThePowerOfItsLight) {
    for (PunctualLight light : {spot(0.2f, 0.9f), spot(0, 0.4f), spot(0.5f, 0.5f)}) {
        light.position = {1, 2, 3};
        double sum = 0;
        RandomStream random(1, 7);
        constexpr int kDraws = 200000;
        for (int i = 0; i < kDraws; ++i)
            sum += beamOf(light, light.position + randomDirection(random), 1e-4f).irradiance.x;
        EXPECT_NEAR(4 * kPi * sum / kDraws / powerOf(light).x, 1, 0.02);
    }
}

TEST(LightBeam, IsFiniteEverywhere) {
    PunctualLight light;
    light.position = {1, 1, 1};
    for (const float d : {0.0f, 1e-30f, 1e-6f})
        EXPECT_TRUE(isFinite(beamOf(light, {1 + d, 1, 1}, 1e-5f).irradiance)) << d;
}

TEST(PickedBeam, MakesTheSumOfAllLightsInTheMean) {
    std::vector<PunctualLight> lights(5, spot(0.2f, 1));
    for (std::size_t i = 0; i < lights.size(); ++i)
        lights[i].position = {0.3f * static_cast<float>(i), 0, 2};
    lights[3].kind = PunctualKind::directional;
    double truth = 0, sum = 0;
    for (const PunctualLight& light : lights) truth += beamOf(light, Vec3(0), 1e-4f).irradiance.x;
    constexpr int kDraws = 1000;
    for (int i = 0; i < kDraws; ++i) {
        const PickedBeam picked =
            pickBeam(lights, Vec3(0), 1e-4f, (static_cast<float>(i) + 0.5f) / kDraws);
        sum += picked.beam.irradiance.x / picked.probability / kDraws;
    }
    EXPECT_NEAR(sum / truth, 1, 0.01);
}

}  // namespace
}  // namespace vlf
