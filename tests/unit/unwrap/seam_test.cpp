// Seams: where one chart goes on in another.

#include "unwrapped_scene.h"

#include <gtest/gtest.h>

#include <set>

namespace vlf::test {

namespace {

constexpr float kTexel = 0.1f;

/// A floor of two materials that meet at x = 1, and a wall along z = 0.
UnwrappedScene floorAndWall() {
    SceneBuilder b;
    const std::uint32_t oak = b.material("oak", Vec3(0.5f)),
                        stone = b.material("stone", Vec3(0.4f));
    b.quad(Vec3(0), {0, 0, 1}, {1, 0, 0}, oak);
    b.quad({1, 0, 0}, {0, 0, 1}, {1, 0, 0}, stone);
    b.quad(Vec3(0), {2, 0, 0}, {0, 1, 0}, stone);
    return {b.scene(), {kTexel}};
}

std::uint32_t chartAt(const Unwrap& u, std::uint32_t texel) {
    const std::uint32_t x = texel % u.atlasWidth, y = texel / u.atlasWidth;
    for (std::uint32_t i = 0; i < u.charts.size(); ++i) {
        const Chart& c = u.charts[i];
        if (x + kGutter >= c.x && x < c.x + c.width + kGutter && y + kGutter >= c.y &&
            y < c.y + c.height + kGutter)
            return i;
    }
    return kNoChart;
}

}  // namespace

TEST(Seams, LinkCoplanarNeighboursOfDifferentMaterials) {
    const UnwrappedScene s = floorAndWall();
    const std::uint32_t oak = s.unwrap.triangleCharts[0].front;
    const std::uint32_t stone = s.unwrap.triangleCharts[2].front;
    int oakToStone = 0, stoneToOak = 0;
    for (const SeamLink& link : s.unwrap.seams) {
        oakToStone += chartAt(s.unwrap, link.texel) == oak && link.chart == stone;
        stoneToOak += chartAt(s.unwrap, link.texel) == stone && link.chart == oak;
    }
    // One link for each of the ten texels along the common edge.
    EXPECT_EQ(oakToStone, 10);
    EXPECT_EQ(stoneToOak, 10);
}

TEST(Seams, DoNotLinkAFloorToAWall) {
    const UnwrappedScene s = floorAndWall();
    const std::uint32_t wall = s.unwrap.triangleCharts[4].front;
    for (const SeamLink& link : s.unwrap.seams) {
        EXPECT_NE(link.chart, wall);
        EXPECT_NE(chartAt(s.unwrap, link.texel), wall);
    }
}

TEST(Seams, PointToWhereTheSurfaceGoesOn) {
    const UnwrappedScene s = floorAndWall();
    for (const SeamLink& link : s.unwrap.seams) {
        const Chart& from = s.unwrap.charts[chartAt(s.unwrap, link.texel)];
        const Vec2 own(link.texel % s.unwrap.atlasWidth - static_cast<float>(from.x) + 0.5f,
                       link.texel / s.unwrap.atlasWidth - static_cast<float>(from.y) + 0.5f);
        // The world point of a chart's texel coordinates, for charts in the plane y = 0.
        const auto world = [](const Chart& c, const Vec2& t) {
            return c.uAxis * ((t.x - c.uOffset) / glm::dot(c.uAxis, c.uAxis)) +
                   c.vAxis * ((t.y - c.vOffset) / glm::dot(c.vAxis, c.vAxis));
        };
        const Chart& to = s.unwrap.charts[link.chart];
        EXPECT_LT(glm::distance(world(from, own), world(to, link.coordinates)), 1e-3f);
    }
}

TEST(Seams, JoinThePatchesOfABall) {
    SceneBuilder b;
    b.sphere(Vec3(0), 1, 4, false, b.material("ball", Vec3(0.5f)));
    const UnwrappedScene ball(b.scene(), {kTexel});
    std::set<std::uint32_t> linked;
    for (const SeamLink& link : ball.unwrap.seams) {
        EXPECT_NE(chartAt(ball.unwrap, link.texel), link.chart);
        linked.insert(link.chart);
    }
    EXPECT_EQ(linked.size(), ball.unwrap.charts.size());
}

}  // namespace vlf::test
