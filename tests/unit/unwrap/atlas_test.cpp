// The atlas as a whole: packing, size, and that nothing but the scene decides it.

#include "unwrapped_scene.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/field/pack_atlas.h"
#include "vlf/math/random.h"
#include "vlf/scene/generate/generate.h"

#include <gtest/gtest.h>

#include <limits>

namespace vlf::test {

namespace {

/// How many charts, gutters included, lie over each texel of the atlas; fails for one that
/// reaches beyond it.
std::vector<int> coverage(const std::vector<Chart>& charts, const AtlasSize& size) {
    std::vector<int> count(static_cast<std::size_t>(size.width) * size.height, 0);
    for (const Chart& c : charts) {
        EXPECT_GE(std::min(c.x, c.y), kGutter);
        EXPECT_LE(c.x + c.width + kGutter, size.width);
        EXPECT_LE(c.y + c.height + kGutter, size.height);
        if (::testing::Test::HasFailure()) return count;
        for (std::uint32_t y = c.y - kGutter; y < c.y + c.height + kGutter; ++y)
            for (std::uint32_t x = c.x - kGutter; x < c.x + c.width + kGutter; ++x)
                ++count[static_cast<std::size_t>(y) * size.width + x];
    }
    return count;
}

void expectNoOverlap(const std::vector<Chart>& charts, const AtlasSize& size) {
    for (const int n : coverage(charts, size)) ASSERT_LE(n, 1);
}

Scene scaled(Scene scene, float factor) {
    for (Vec3& p : scene.positions) p *= factor;
    return scene;
}

void expectSameUnwrap(const Unwrap& a, const Unwrap& b) {
    ASSERT_EQ(a.charts.size(), b.charts.size());
    for (std::size_t i = 0; i < a.charts.size(); ++i) {
        EXPECT_EQ(a.charts[i].uAxis, b.charts[i].uAxis);
        EXPECT_EQ(a.charts[i].vOffset, b.charts[i].vOffset);
        EXPECT_EQ(a.charts[i].x, b.charts[i].x);
        EXPECT_EQ(a.charts[i].y, b.charts[i].y);
    }
    EXPECT_EQ(a.texels, b.texels);
    EXPECT_EQ(a.texelChart, b.texelChart);
    EXPECT_EQ(a.pointArea, b.pointArea);
    EXPECT_EQ(a.proxies, b.proxies);
    EXPECT_EQ(a.points.first, b.points.first);
    for (std::size_t i = 0; i < a.points.points.size(); ++i) {
        ASSERT_EQ(a.points.points[i].triangle, b.points.points[i].triangle);
        ASSERT_EQ(a.points.points[i].barycentric, b.points.points[i].barycentric);
    }
    ASSERT_EQ(a.seams.size(), b.seams.size());
    for (std::size_t i = 0; i < a.seams.size(); ++i) {
        ASSERT_EQ(a.seams[i].texel, b.seams[i].texel);
        ASSERT_EQ(a.seams[i].coordinates, b.seams[i].coordinates);
    }
}

}  // namespace

TEST(PackCharts, NeverOverlapsAndWastesLittle) {
    for (int trial = 0; trial < 20; ++trial) {
        RandomStream random(3, trial);
        std::vector<Chart> charts(1 + trial * 20);
        double used = 0;
        for (Chart& c : charts) {
            c.width = 1 + static_cast<std::uint32_t>(60 * random.next());
            c.height = 1 + static_cast<std::uint32_t>(60 * random.next());
            used += (c.width + 2.0 * kGutter) * (c.height + 2.0 * kGutter);
        }
        const AtlasSize size = packCharts(charts);
        expectNoOverlap(charts, size);
        const double wasted = 1 - used / size.width / size.height;
        EXPECT_LT(wasted, charts.size() > 100 ? 0.15 : 1.0);
    }
}

TEST(PackCharts, HoldsASingleLongChart) {
    std::vector<Chart> charts(3);
    charts[0].width = 5000, charts[0].height = 1;
    charts[1].width = 1, charts[1].height = 3000;
    charts[2].width = charts[2].height = 1;
    expectNoOverlap(charts, packCharts(charts));
}

TEST(Atlas, RectanglesWithGuttersNeverOverlap) {
    for (const char* name : {"cornell", "mirror-room", "office"}) {
        const UnwrappedScene room(generateScene(name, {}), {0, 20000});
        expectNoOverlap(room.unwrap.charts, {room.unwrap.atlasWidth, room.unwrap.atlasHeight});
    }
}

TEST(Atlas, KeepsToTheBudget) {
    for (const char* name : {"cornell", "two-rooms", "mirror-room", "office"}) {
        const UnwrappedScene room(generateScene(name, {}), {0, 40000});
        const auto texels = static_cast<double>(room.unwrap.texels.size());
        EXPECT_GT(texels, 0.7 * 40000) << name;
        EXPECT_LT(texels, 1.7 * 40000) << name;
    }
}

TEST(Atlas, TexelsAreNotLargerThanAsked) {
    const UnwrappedScene room(generateScene("cornell"), {0.13f});
    for (const Chart& c : room.unwrap.charts) {
        EXPECT_LE(1 / glm::length(c.uAxis), 0.13f * 1.02f);
        EXPECT_LE(1 / glm::length(c.vAxis), 0.13f * 1.02f);
    }
}

TEST(Atlas, IsTheSameAtAnyScale) {
    const Scene scene = generateScene("mirror-room", {1500});
    const UnwrappedScene room(scene, {0, 20000});
    for (const float factor : {1e-3f, 1e4f}) {
        const UnwrappedScene other(scaled(scene, factor), {0, 20000});
        EXPECT_EQ(other.unwrap.charts.size(), room.unwrap.charts.size()) << factor;
        // Rays along a seam may fall to either side.
        EXPECT_NEAR(static_cast<double>(other.unwrap.texels.size()),
                    static_cast<double>(room.unwrap.texels.size()), 5)
            << factor;
    }
}

TEST(Atlas, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = generateScene("mirror-room", {1500});
    const auto unwrapped = [&](int threads) {
        const ThreadLimit limit(threads);
        return UnwrappedScene(scene, {0, 20000}).unwrap;
    };
    const Unwrap one = unwrapped(1);
    expectSameUnwrap(one, unwrapped(2));
    expectSameUnwrap(one, unwrapped(7));
}

TEST(Atlas, RefusesAbsurdlySmallTexels) {
    const Scene scene = generateScene("cornell");
    const RayScene rays(scene);
    EXPECT_THROW(unwrap(scene, rays, {1e-6f}), InputError);
    EXPECT_THROW(unwrap(scene, rays, {std::numeric_limits<float>::denorm_min()}), InputError);
}

TEST(Atlas, OfAFinishedFieldIsFoundAgain) {
    const UnwrappedScene room(generateScene("cornell"), {0, 20000});
    const Unwrap& u = room.unwrap;
    const Unwrap again = restoreUnwrap(room.scene, room.rays, u.charts, u.triangleCharts,
                                       {u.atlasWidth, u.atlasHeight});
    EXPECT_EQ(again.texels, u.texels);
    EXPECT_EQ(again.texelChart, u.texelChart);
    EXPECT_EQ(again.points.first, u.points.first);
}

}  // namespace vlf::test
