#include "vlf/scene/import/polygon.h"

#include "vlf/math/random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vlf {
namespace {

/// Sum of the triangles' signed areas along the polygon's normal, and of their absolute areas.
struct Areas {
    double netArea = 0, grossArea = 0;
};

Areas triangulatedAreas(const std::vector<Vec3>& polygon) {
    const glm::dvec3 normal = glm::normalize(polygonAreaVector(polygon));
    Areas areas;
    for (const auto& t : triangulatePolygon(polygon)) {
        const glm::dvec3 a = polygon[t[0]], b = polygon[t[1]], c = polygon[t[2]];
        const double twice = glm::dot(glm::cross(b - a, c - a), normal);
        areas.netArea += 0.5 * twice;
        areas.grossArea += 0.5 * std::abs(twice);
    }
    return areas;
}

void expectExactCover(const std::vector<Vec3>& polygon, double tolerance = 1e-6) {
    const double expected = 0.5 * glm::length(polygonAreaVector(polygon));
    const Areas areas = triangulatedAreas(polygon);
    EXPECT_EQ(triangulatePolygon(polygon).size(), polygon.size() - 2);
    EXPECT_NEAR(areas.netArea, expected, tolerance * expected);
    EXPECT_NEAR(areas.grossArea, expected, tolerance * expected) << "triangles overlap or flip";
}

TEST(TriangulatePolygon, CutsAConvexQuadAlongItsFirstDiagonal) {
    const std::vector<Vec3> quad{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const auto triangles = triangulatePolygon(quad);
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(triangles[0], (std::array<int, 3>{0, 1, 2}));
    expectExactCover(quad);
}

TEST(TriangulatePolygon, CoversAConcaveQuadFromAnyFirstCorner) {
    std::vector<Vec3> arrow{{0, 0, 0}, {2, -1, 0}, {0.5f, 0, 0}, {2, 1, 0}};
    for (int i = 0; i < 4; ++i) {
        expectExactCover(arrow);
        std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
    }
}

TEST(TriangulatePolygon, CoversRandomStarsInAnyPlaneAndEitherWinding) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        RandomStream random(seed, 1);
        const int corners = 5 + static_cast<int>(random.next() * 60);
        const Vec3 u(random.next(), random.next() - 0.5f, random.next() + 0.1f);
        const Vec3 v = glm::cross(u, Vec3(random.next() + 0.2f, -0.7f, 0.3f));
        std::vector<Vec3> star;
        for (int i = 0; i < corners; ++i) {
            const float radius = 0.1f + random.next(), angle = 2 * kPi * i / corners;
            star.push_back(radius * (std::cos(angle) * u + std::sin(angle) * v));
        }
        if (seed % 2) std::reverse(star.begin(), star.end());
        expectExactCover(star, 1e-4);
    }
}

TEST(TriangulatePolygon, LeavesAHoleReachedByABridgeOpen) {
    const std::vector<Vec3> frame{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                  {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    const Areas areas = triangulatedAreas(frame);
    EXPECT_NEAR(areas.netArea, 12, 1e-6);
    EXPECT_NEAR(areas.grossArea, 12, 1e-6);
}

TEST(TriangulatePolygon, CoversACombOfTwoThousandCorners) {
    std::vector<Vec3> comb;
    for (int i = 0; i < 1000; ++i) comb.insert(comb.end(), {{i, 0, 0}, {i + 0.5f, -10, 0}});
    comb.insert(comb.end(), {{1000, 0, 0}, {1000, 1, 0}, {0, 1, 0}});
    expectExactCover(comb);
}

TEST(TriangulatePolygon, EndsOnPolygonsWithoutAreaOrThatCrossThemselves) {
    const std::vector<std::vector<Vec3>> polygons{
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
        {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},
        {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {0, 1, 0}}};
    for (const auto& polygon : polygons)
        EXPECT_EQ(triangulatePolygon(polygon).size(), polygon.size() - 2);
}

}  // namespace
}  // namespace vlf
