#include "vlf/scene/emitter_sampler.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

using test::SceneBuilder;

/// A texture whose left half is black and right half white.
Texture halfWhite() {
    Texture t;
    t.width = 64, t.height = 64;
    t.wrapU = t.wrapV = Wrap::clamp;
    for (int i = 0; i < 64 * 64; ++i) t.linear.push_back(Vec3(i % 64 < 32 ? 0.0f : 1.0f));
    return t;
}

Scene threeLamps() {
    SceneBuilder b;
    b.triangle(Vec3(0), {1, 0, 0}, {0, 1, 0}, b.material("dark", Vec3(0.5f)));
    b.triangle(Vec3(0), {1, 0, 0}, {0, 1, 0}, b.material("weak", Vec3(0), Vec3(1)));
    b.triangle(Vec3(0), {2, 0, 0}, {0, 1, 0}, b.material("large", Vec3(0), Vec3(1)));
    b.triangle(Vec3(0), {1, 0, 0}, {0, 1, 0}, b.material("both", Vec3(0), Vec3(0, 0, 6)));
    b.scene().materials.back().emitsBothSides = true;
    return b.scene();
}

TEST(EmitterSampler, PicksTrianglesInProportionToTheirPower) {
    const Scene scene = threeLamps();
    const EmitterSampler emitters(scene);
    const double expected[] = {0, 3.0 / 21, 6.0 / 21, 12.0 / 21};
    int counts[4] = {};
    RandomStream random(1, 2);
    constexpr int kDraws = 100000;
    for (int i = 0; i < kDraws; ++i) ++counts[emitters.sample(random).triangle];
    for (int i = 0; i < 4; ++i) {
        const double deviation = std::sqrt(kDraws * expected[i] * (1 - expected[i]));
        EXPECT_LE(std::abs(counts[i] - kDraws * expected[i]), 4 * deviation) << i;
    }
}

TEST(EmitterSampler, DensityTimesAreaIsTheChanceOfATriangle) {
    const Scene scene = threeLamps();
    const EmitterSampler emitters(scene);
    EXPECT_EQ(emitters.density(0), 0);
    EXPECT_NEAR(emitters.density(1) * 0.5, 3.0 / 21, 1e-6);
    EXPECT_NEAR(emitters.density(2) * 1.0, 6.0 / 21, 1e-6);
    EXPECT_NEAR(emitters.density(3) * 0.5, 12.0 / 21, 1e-6);
}

TEST(EmitterSampler, PointsAreUniformInTheTriangle) {
    const Scene scene = threeLamps();
    const EmitterSampler emitters(scene);
    RandomStream random(1, 2);
    Vec2 sum(0);
    constexpr int kDraws = 100000;
    for (int i = 0; i < kDraws; ++i) {
        const Vec2 b = emitters.sample(random).barycentric;
        ASSERT_GE(b.x, 0);
        ASSERT_GE(b.y, 0);
        ASSERT_LE(b.x + b.y, 1 + 1e-6f);
        sum += b;
    }
    // A barycentric coordinate of a uniform point has mean 1/3 and variance 1/18.
    const double deviation = std::sqrt(1.0 / 18 / kDraws);
    EXPECT_NEAR(sum.x / kDraws, 1 / 3.0, 4 * deviation);
    EXPECT_NEAR(sum.y / kDraws, 1 / 3.0, 4 * deviation);
}

TEST(EmitterSampler, MeanEmissionFollowsTheTexture) {
    SceneBuilder b;
    const std::uint32_t lamp = b.material("lamp", Vec3(0), {4, 2, 1});
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, lamp);
    Scene scene = b.scene();
    scene.textures.push_back(halfWhite());
    scene.materials[lamp].emissionTexture = 0;
    // Triangle 0 covers uv (0,0) (1,0) (1,1): three quarters of it are white.
    EXPECT_NEAR(meanEmission(scene, 0).x, 3, 0.06);
    EXPECT_NEAR(meanEmission(scene, 1).x, 1, 0.06);
    EXPECT_NEAR(meanEmission(scene, 0).z, 0.75, 0.02);
}

TEST(EmitterSampler, IsEmptyWithoutEmitters) {
    SceneBuilder b;
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, b.material("dark", Vec3(0.5f)));
    EXPECT_TRUE(EmitterSampler(b.scene()).empty());
    EXPECT_TRUE(EmitterSampler(Scene{}).empty());
}

}  // namespace
}  // namespace vlf
