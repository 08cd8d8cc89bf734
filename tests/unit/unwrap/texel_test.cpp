// The texels' surface points.

#include "unwrapped_scene.h"

#include "vlf/scene/generate/generate.h"
#include "vlf/unwrap/buried_points.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vlf::test {

TEST(TexelPoints, LieInTheirTexel) {
    for (const char* name : {"cornell", "mirror-room"}) {
        const UnwrappedScene room(generateScene(name), {0, 20000});
        const Unwrap& u = room.unwrap;
        for (std::size_t i = 0; i < u.texels.size(); ++i) {
            const Chart& chart = u.charts[u.texelChart[i]];
            const Vec2 corner(u.texels[i] % u.atlasWidth - static_cast<float>(chart.x),
                              u.texels[i] / u.atlasWidth - static_cast<float>(chart.y));
            for (const SurfacePoint& p : u.points.of(i)) {
                const Vec2 q = chart.texelCoordinates(room.position(p)) - corner;
                ASSERT_GT(std::min(q.x, q.y), -0.01f) << name << " texel " << i;
                ASSERT_LT(std::max(q.x, q.y), 1.01f) << name << " texel " << i;
            }
        }
    }
}

TEST(TexelPoints, BelongToTheTexelsChart) {
    const UnwrappedScene room(generateScene("mirror-room", {2000}), {0, 20000});
    const Unwrap& u = room.unwrap;
    for (std::size_t i = 0; i < u.texels.size(); ++i) {
        ASSERT_FALSE(u.points.of(i).empty());
        for (const SurfacePoint& p : u.points.of(i)) {
            const TriangleCharts& charts = u.triangleCharts[p.triangle];
            ASSERT_TRUE(charts.front == u.texelChart[i] || charts.back == u.texelChart[i]);
            ASSERT_GE(std::min(p.barycentric.x, p.barycentric.y), -1e-4f);
            ASSERT_LE(p.barycentric.x + p.barycentric.y, 1 + 1e-4f);
        }
    }
}

TEST(TexelPoints, AWholeTexelHasAFullGrid) {
    SceneBuilder b;
    b.quad(Vec3(0), {0, 0, 1}, {1, 0, 0}, b.material("floor", Vec3(0.5f)));
    const UnwrappedScene s(b.scene(), {0.1f});
    ASSERT_EQ(s.unwrap.texels.size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(s.unwrap.points.of(i).size(), static_cast<std::size_t>(kTexelGrid * kTexelGrid));
        EXPECT_NEAR(s.unwrap.texelArea(i), 0.01f, 1e-6f);
    }
}

TEST(TexelPoints, TrianglesSmallerThanATexelKeepAPoint) {
    SceneBuilder b;
    b.sphere(Vec3(0), 1, 3, false, b.material("ball", Vec3(0.5f)));
    const UnwrappedScene s(b.scene(), {1.0f});
    std::vector<bool> seen(s.scene.triangles.size(), false);
    for (const SurfacePoint& p : s.unwrap.points.points) seen[p.triangle] = true;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0);
}

TEST(BuriedPoints, FloorUnderABlockIsDropped) {
    for (const float bottom : {0.0f, -0.05f}) {
        SceneBuilder b = litRoom();
        b.box({1, bottom, 1}, {2.2f, 1, 2.2f}, false, b.material("block", Vec3(0.5f)));
        const UnwrappedScene room(b.scene(), {0.1f});
        const std::uint32_t floor = room.unwrap.triangleCharts[4].front;
        double area = 0;
        for (std::size_t i = 0; i < room.unwrap.texels.size(); ++i) {
            if (room.unwrap.texelChart[i] != floor) continue;
            area += room.unwrap.texelArea(i);
            for (const SurfacePoint& point : room.unwrap.points.of(i)) {
                const Vec3 p = room.position(point);
                const bool under = p.x > 1.001f && p.x < 2.199f && p.z > 1.001f && p.z < 2.199f;
                ASSERT_FALSE(under) << p.x << " " << p.z << ", block from " << bottom;
            }
        }
        EXPECT_NEAR(area, 16 - 1.2 * 1.2, 0.1) << "block from " << bottom;
    }
}

TEST(BuriedPoints, FloorUnderATableStays) {
    SceneBuilder b = litRoom();
    b.box({1, 0.7f, 1}, {2, 0.8f, 2}, false, b.material("table", Vec3(0.5f)));
    const UnwrappedScene room(b.scene(), {0.1f});
    const std::uint32_t floor = room.unwrap.triangleCharts[4].front;
    EXPECT_EQ(std::count(room.unwrap.texelChart.begin(), room.unwrap.texelChart.end(), floor),
              40 * 40);
}

TEST(BuriedPoints, AClosedSideFarAboveBuriesNothing) {
    for (const float height : {0.01f, 2.0f}) {
        SceneBuilder b = litRoom();
        const auto panel = static_cast<std::uint32_t>(b.scene().triangles.size());
        b.quad({1, height, 1}, {0, 0, 1}, {1, 0, 0}, b.material("panel", Vec3(0.5f)));
        UnwrappedScene room(b.scene(), {0.1f});
        const std::uint32_t floor = room.unwrap.triangleCharts[4].front;
        for (const std::uint32_t t : {panel, panel + 1})
            room.unwrap.triangleCharts[t].back = kNoChart;
        dropBuriedPoints(room.scene, RayScene(room.scene), room.unwrap, Progress());
        const auto texels =
            std::count(room.unwrap.texelChart.begin(), room.unwrap.texelChart.end(), floor);
        EXPECT_EQ(texels, height > 1 ? 40 * 40 : 40 * 40 - 10 * 10) << height;
    }
}

}  // namespace vlf::test
