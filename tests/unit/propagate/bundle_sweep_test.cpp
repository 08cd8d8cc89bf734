// One bundle of parallel rays: who exchanges light with whom.

#include "swept_scene.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/generate.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

constexpr float kTexel = 0.1f;
constexpr Vec3 kUp{0, 1, 0};

/// Horizontal unit squares at these heights, facing up or down; square i has triangles 2i, 2i + 1.
Scene squares(const std::vector<std::pair<float, bool>>& heightAndUp) {
    SceneBuilder b;
    const std::uint32_t grey = b.material("grey", Vec3(0.5f));
    for (const auto& [height, up] : heightAndUp) addSquare(b, height, up, grey);
    return b.scene();
}

/// Cells whose rays meet a unit square perpendicular to the bundle, give or take its edge.
void expectUnitSquareOfCells(double count, const SweptScene& s, int cells) {
    const double cell = 2.0 * s.frame.radius / (cells - 1);
    EXPECT_NEAR(count, 1 / (cell * cell), 4 / cell);
}

void expectSum(const SweptScene::Sum& sum, const Vec3& each) {
    const Vec3 expected = sum.samples * each;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum.rgb[c], expected[c], 1e-4 * sum.samples);
}

}  // namespace

TEST(BundleSweep, FacingSquaresExchangeBothWays) {
    SweptScene s(squares({{0, true}, {1, false}}), kTexel);
    s.setRadiance(0, {1, 2, 3});
    s.setRadiance(2, {4, 5, 6});
    for (const Vec3& direction : {kUp, -kUp}) {
        s.gathered.reset(s.gathered.texelCount());
        const std::uint64_t exchanges = s.sweep(direction, 200);
        const auto lower = s.gatheredBy(0), upper = s.gatheredBy(2);
        EXPECT_EQ(lower.samples, static_cast<float>(exchanges));
        EXPECT_EQ(upper.samples, static_cast<float>(exchanges));
        expectUnitSquareOfCells(static_cast<double>(exchanges), s, 200);
        expectSum(lower, {4, 5, 6});
        expectSum(upper, {1, 2, 3});
        EXPECT_EQ(s.gathered.weight(s.outside()), 0);
    }
}

TEST(BundleSweep, EveryTexelOfASquareIsMetAlike) {
    SweptScene s(squares({{0, true}, {1, false}}), kTexel);
    s.sweep(kUp, 400, 0.3f);
    const double cell = 2.0 * s.frame.radius / 399;
    for (const Chart& c : s.unwrap.charts)
        for (std::uint32_t i = 0; i < c.width * c.height; ++i) {
            const std::uint32_t x = c.x + i % c.width, y = c.y + i / c.width;
            EXPECT_NEAR(s.gathered.weight(y * s.unwrap.atlasWidth + x), 0.01 / (cell * cell),
                        0.15 * 0.01 / (cell * cell));
        }
}

TEST(BundleSweep, SamplesAreInProportionToTheCosine) {
    SweptScene s(squares({{0, true}}), kTexel);
    s.sweep(kUp, 1000);
    const float straight = s.gatheredBy(0).samples;
    s.gathered.reset(s.gathered.texelCount());
    s.sweep(glm::normalize(Vec3(1, 1, 0)), 1000);
    EXPECT_NEAR(s.gatheredBy(0).samples / straight, std::sqrt(0.5), 0.003);
}

TEST(BundleSweep, ASquareAloneSeesTheOutside) {
    SweptScene s(squares({{0, true}, {0.5f, true}}), kTexel);
    s.setOutside({7, 8, 9});
    s.setRadiance(0, Vec3(100));
    s.sweep(kUp, 200);
    expectUnitSquareOfCells(s.gatheredBy(2).samples, s, 200);
    expectSum(s.gatheredBy(2), {7, 8, 9});
}

TEST(BundleSweep, TheBackOfASurfaceIsNoSample) {
    SweptScene s(squares({{0, true}, {0.5f, true}}), kTexel);
    s.setRadiance(2, Vec3(5));
    s.sweep(kUp, 200);
    s.sweep(-kUp, 200);
    EXPECT_EQ(s.gatheredBy(0).samples, 0);
    EXPECT_EQ(maxComponent(s.gatheredBy(0).rgb), 0);
}

TEST(BundleSweep, TouchingSurfacesExchangeNothing) {
    for (const bool upperFirst : {false, true}) {
        SweptScene s(upperFirst ? squares({{0, false}, {0, true}, {1, false}})
                                : squares({{0, true}, {0, false}, {1, false}}),
                     kTexel);
        const std::uint32_t floor = upperFirst ? 2 : 0, under = upperFirst ? 0 : 2;
        s.setRadiance(floor, Vec3(3));
        s.setRadiance(under, Vec3(100));
        s.setRadiance(4, Vec3(1));
        RandomStream random(5, 6);
        for (int i = 0; i < 50; ++i) s.sweep(sampleUniformSphere(random.next2()), 100);
        EXPECT_EQ(maxComponent(s.gatheredBy(under).rgb), 0);
        // The floor sees the square above it or the dark outside.
        EXPECT_LE(maxComponent(s.gatheredBy(floor).rgb), s.gatheredBy(floor).samples);
        EXPECT_GT(maxComponent(s.gatheredBy(floor).rgb), 0);
    }
}

TEST(BundleSweep, AHundredLayersAreNotLost) {
    std::vector<std::pair<float, bool>> stack;
    for (int i = 0; i < 100; ++i) stack.emplace_back(0.01f * static_cast<float>(i), i % 2 == 0);
    SweptScene s(squares(stack), kTexel);
    for (std::uint32_t i = 0; i < 100; ++i) s.setRadiance(2 * i, Vec3(static_cast<float>(i + 1)));
    const std::uint64_t exchanges = s.sweep(kUp, 150);
    EXPECT_EQ(exchanges % 50, 0u);
    expectUnitSquareOfCells(static_cast<double>(exchanges) / 50, s, 150);
    for (std::uint32_t i = 0; i < 100; ++i) {
        const std::uint32_t partner = i % 2 == 0 ? i + 1 : i - 1;
        EXPECT_EQ(s.gatheredBy(2 * i).samples, static_cast<float>(exchanges / 50)) << i;
        expectSum(s.gatheredBy(2 * i), Vec3(static_cast<float>(partner + 1)));
    }
}

TEST(BundleSweep, ReusedScratchGivesTheSame) {
    const Scene scene = smallCornell();
    SweptScene fresh(scene, 0.05f), reused(scene, 0.05f);
    reused.sweep({1, 0, 0}, 333);
    reused.sweep({0, 0, 1}, 64);
    reused.gathered.reset(reused.gathered.texelCount());
    const Vec3 direction = glm::normalize(Vec3(1, 2, 3));
    EXPECT_EQ(fresh.sweep(direction, 128), reused.sweep(direction, 128));
    for (std::size_t i = 0; i <= fresh.outside(); ++i)
        ASSERT_EQ(fresh.gathered.weight(i), reused.gathered.weight(i));
}

TEST(BundleSweep, ReportsWhoSeesAMirror) {
    SceneBuilder b;
    addSquare(b, 0, true, b.material("grey", Vec3(0.5f)));
    addSquare(b, 1, false, b.material("mirror", Vec3(0), Vec3(0), Vec3(0.9f)));
    SweptScene s(b.scene(), kTexel);
    const std::uint64_t exchanges = s.sweep(kUp, 100);
    ASSERT_EQ(s.sights.size(), exchanges);
    for (const MirrorSight& sight : s.sights) {
        EXPECT_TRUE(sight.forward);
        EXPECT_GT(s.gathered.weight(sight.receiver), 0);
        EXPECT_NEAR(sight.mirrorDepth - sight.receiverDepth, 1, 1e-3);
    }
}

namespace {

/// Sweeps many random bundles of many sizes through a closed scene: nothing may see the outside.
/// Returns the share of samples that did.
double outsideShare(const Scene& scene, float texelSize, int bundles) {
    SweptScene s(scene, texelSize);
    std::uint64_t exchanges = 0;
    for (int i = 0; i < bundles; ++i) {
        RandomStream random(9, i);
        const Vec3 direction = sampleUniformSphere(random.next2());
        const int cells = 16 + static_cast<int>(300 * random.next());
        exchanges += s.sweep(direction, cells, 6 * random.next(), random.next2());
    }
    double samples = 0;
    for (std::size_t i = 0; i < s.outside(); ++i) samples += s.gathered.weight(i);
    const double outside = s.gathered.weight(s.outside());
    // Each exchange is two samples, one on either side.
    EXPECT_EQ(samples + outside, 2.0 * static_cast<double>(exchanges));
    EXPECT_GT(samples, 0);
    return outside / samples;
}

}  // namespace

TEST(BundleSweep, NothingLeavesAClosedBox) {
    EXPECT_LT(outsideShare(furnaceBox(Vec3(0.5f), Vec3(0)), 0.1f, 400), 2e-5);
}

TEST(BundleSweep, NothingLeavesAClosedSphere) {
    EXPECT_LT(outsideShare(furnaceSphere(Vec3(0.5f), Vec3(0), 3), 0.1f, 400), 2e-5);
}

TEST(BundleSweep, NothingLeavesARoomWithSharedWalls) {
    // Where surfaces meet, rays that pass within the contact bias of the edge are lost.
    EXPECT_LT(outsideShare(generateScene("two-rooms"), 0.2f, 200), 1e-4);
}

}  // namespace vlf::test
