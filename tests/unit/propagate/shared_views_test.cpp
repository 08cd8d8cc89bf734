#include "vlf/propagate/shared_views.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

using Indices = std::vector<std::uint32_t>;

TEST(SharedViews, AreThoseOfTheFirstPointCloseBy) {
    const Vec3 up(0, 1, 0);
    const std::vector<ViewPoint> points{
        {{0, 0, 0}, up}, {{5, 0, 0}, up}, {{0.1f, 0, -0.2f}, up}, {{5.1f, 0, 0}, up}};
    EXPECT_EQ(firstNearby(points, 1), (Indices{0, 1, 0, 1}));
}

TEST(SharedViews, AreNotThoseOfPointsThatFaceElsewhere) {
    const std::vector<ViewPoint> points{{Vec3(0), {0, 1, 0}}, {Vec3(0), {1, 0, 0}}};
    EXPECT_EQ(firstNearby(points, 1), (Indices{0, 1}));
}

TEST(SharedViews, OfPointsAWholeCellApartAreTheirOwn) {
    std::vector<ViewPoint> points;
    Indices own;
    for (int i = 0; i < 50; ++i) {
        points.push_back({static_cast<float>(i) * Vec3(0.6f, 0.3f, 0.75f), {0, 0, 1}});
        own.push_back(static_cast<std::uint32_t>(i));
    }
    EXPECT_EQ(firstNearby(points, 0.5f), own);
}

TEST(SharedViews, OfNoPointsAreNone) {
    EXPECT_TRUE(firstNearby({}, 1).empty());
}

}  // namespace
}  // namespace vlf
