// Which triangles share a chart, and how charts map the surface.

#include "unwrapped_scene.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/generate.h"
#include "vlf/unwrap/chart_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vlf::test {

namespace {

constexpr float kTexel = 0.05f;

/// Two squares side by side in the plane y = 0.
Scene twoSquares(bool sameMaterial) {
    SceneBuilder b;
    const std::uint32_t red = b.material("red", Vec3(0.5f)), blue = b.material("blue", Vec3(0.5f));
    b.quad(Vec3(0), {0, 0, 1}, {1, 0, 0}, red);
    b.quad({1, 0, 0}, {0, 0, 1}, {1, 0, 0}, sameMaterial ? red : blue);
    return b.scene();
}

Scene ballAlone(int levels) {
    SceneBuilder b;
    b.sphere(Vec3(0), 1, levels, false, b.material("ball", Vec3(0.5f)));
    return b.scene();
}

/// The largest distance between two points of one texel, in texels.
float largestSpread(const UnwrappedScene& s) {
    float largest = 0;
    for (std::size_t i = 0; i < s.unwrap.texels.size(); ++i)
        for (const SurfacePoint& a : s.unwrap.points.of(i))
            for (const SurfacePoint& b : s.unwrap.points.of(i))
                largest = std::max(largest, glm::distance(s.position(a), s.position(b)));
    return largest / s.unwrap.texelSize;
}

/// Whether `point`, seen from the side that faces `normal`, lies under other geometry.
bool isBuried(const UnwrappedScene& s, const Vec3& point, const Vec3& normal) {
    const Hit hit = s.rays.closest({point + s.rays.epsilon() * normal, normal});
    if (!hit) return false;
    const TriangleCharts& charts = s.unwrap.triangleCharts[hit.triangle];
    const bool front = glm::dot(geometricNormal(s.scene, hit.triangle), normal) < 0;
    return (front ? charts.front : charts.back) == kNoChart;
}

/// Share of random points in the open whose texel is neither covered nor has a proxy.
double uncoveredShare(const UnwrappedScene& s, int pointsPerTriangle) {
    const Unwrap& u = s.unwrap;
    std::vector<bool> known(u.atlasSize(), false);
    for (const std::uint32_t texel : u.texels) known[texel] = true;
    for (const auto& [texel, proxy] : u.proxies) known[texel] = true;
    for (const ChartTexel& t : u.divided) known[t.texel] = true;
    RandomStream random(1, 2);
    double missed = 0, all = 0;
    for (std::uint32_t t = 0; t < s.scene.triangles.size(); ++t)
        for (const std::uint32_t c : {u.triangleCharts[t].front, u.triangleCharts[t].back}) {
            if (c == kNoChart) continue;
            const Chart& chart = u.charts[c];
            const double weight = area(s.scene, t) / pointsPerTriangle;
            const Vec3 normal = geometricNormal(s.scene, t) * (s.isFront(t, c) ? 1.0f : -1.0f);
            for (int k = 0; k < pointsPerTriangle; ++k) {
                const Vec3 p = positionAt(s.scene, t, sampleUniformTriangle(random.next2()));
                if (isBuried(s, p, normal)) continue;
                all += weight;
                const Vec2 q = chart.texelCoordinates(p);
                EXPECT_GT(std::min(q.x, q.y), -0.01f);
                EXPECT_LT(q.x, chart.width + 0.01f);
                EXPECT_LT(q.y, chart.height + 0.01f);
                const auto x = std::clamp<int>(static_cast<int>(q.x), 0, chart.width - 1);
                const auto y = std::clamp<int>(static_cast<int>(q.y), 0, chart.height - 1);
                if (!known[(chart.y + y) * u.atlasWidth + chart.x + x]) missed += weight;
            }
        }
    return missed / all;
}

/// The smallest cosine between a side and the normal of its chart.
float smallestCosine(const UnwrappedScene& s) {
    float smallest = 1;
    for (std::uint32_t t = 0; t < s.scene.triangles.size(); ++t) {
        const TriangleCharts& c = s.unwrap.triangleCharts[t];
        const Vec3 n = geometricNormal(s.scene, t);
        if (c.front != kNoChart)
            smallest = std::min(smallest, glm::dot(n, s.unwrap.charts[c.front].normal));
        if (c.back != kNoChart)
            smallest = std::min(smallest, -glm::dot(n, s.unwrap.charts[c.back].normal));
    }
    return smallest;
}

}  // namespace

TEST(ChartGroups, CoplanarNeighboursOfOneMaterialShareAChart) {
    const auto groups = groupTriangles(twoSquares(true), kTexel);
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_EQ(groups[0].triangles, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_TRUE(groups[0].planar);
    EXPECT_NEAR(groups[0].axis.y, 1, 1e-6);
}

TEST(ChartGroups, DifferentMaterialsDoNotShareAChart) {
    const auto groups = groupTriangles(twoSquares(false), kTexel);
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].triangles, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(groups[1].triangles, (std::vector<std::uint32_t>{2, 3}));
}

TEST(ChartGroups, CoplanarPiecesThatDoNotTouchAreApart) {
    SceneBuilder b;
    const std::uint32_t wall = b.material("wall", Vec3(0.5f));
    b.quad(Vec3(0), {0, 0, 1}, {1, 0, 0}, wall);
    b.quad({1.5f, 0, 0}, {0, 0, 1}, {1, 0, 0}, wall);
    EXPECT_EQ(groupTriangles(b.scene(), kTexel).size(), 2u);
}

TEST(ChartGroups, ABoxHasSixPlanarCharts) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", Vec3(0.5f)));
    const auto groups = groupTriangles(b.scene(), kTexel);
    ASSERT_EQ(groups.size(), 6u);
    for (const ChartGroup& g : groups) EXPECT_TRUE(g.planar && g.triangles.size() == 2);
}

TEST(ChartGroups, EveryTriangleBelongsToExactlyOneGroup) {
    const Scene scene = generateScene("mirror-room", {2000});
    std::vector<int> count(scene.triangles.size(), 0);
    for (const ChartGroup& g : groupTriangles(scene, kTexel))
        for (const std::uint32_t t : g.triangles) ++count[t];
    EXPECT_EQ(std::count(count.begin(), count.end(), 1),
              static_cast<std::ptrdiff_t>(scene.triangles.size()));
}

TEST(ChartGroups, AFineMeshNeedsFewerChartsThanTriangles) {
    const Scene scene = ballAlone(4);
    EXPECT_LT(groupTriangles(scene, kTexel).size(), scene.triangles.size() / 50);
}

TEST(Charts, MapABallOneToOne) {
    const UnwrappedScene ball(ballAlone(4), {kTexel});
    EXPECT_LT(largestSpread(ball), 3.0f);
    EXPECT_GT(smallestCosine(ball), 0.1f);
    EXPECT_EQ(uncoveredShare(ball, 8), 0.0);
}

TEST(Charts, MapAStatueOneToOne) {
    const UnwrappedScene room(generateScene("mirror-room", {5000}), {0, 60000});
    EXPECT_LT(largestSpread(room), 5.0f);
    EXPECT_GT(smallestCosine(room), 0.0f);
}

TEST(Charts, CoverTheWholeSurface) {
    const UnwrappedScene room(generateScene("mirror-room", {2000}), {0, 40000});
    EXPECT_LT(uncoveredShare(room, 64), 1e-4);
}

TEST(Charts, AThinWallDividesFewTexels) {
    const UnwrappedScene rooms(generateScene("sealed"), {0, 20000});
    EXPECT_GT(rooms.unwrap.divided.size(), 50u);
    EXPECT_LT(rooms.unwrap.divided.size(), 0.03 * rooms.unwrap.texels.size());
}

TEST(Charts, HaveTheAreaOfTheSurface) {
    const UnwrappedScene ball(ballAlone(4), {kTexel});
    double surface = 0, texels = 0;
    for (std::uint32_t t = 0; t < ball.scene.triangles.size(); ++t) surface += area(ball.scene, t);
    for (std::size_t i = 0; i < ball.unwrap.texels.size(); ++i) texels += ball.unwrap.texelArea(i);
    EXPECT_NEAR(texels / surface, 1, 1e-4);
}

}  // namespace vlf::test
