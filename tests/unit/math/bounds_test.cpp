#include "vlf/math/bounds.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

TEST(Bounds, AreEmptyUntilAPointIsAdded) {
    Bounds bounds;
    EXPECT_TRUE(bounds.empty());
    EXPECT_EQ(bounds.size(), Vec3(0));
    bounds.add({1, 2, 3});
    EXPECT_FALSE(bounds.empty());
    EXPECT_EQ(bounds.centre(), Vec3(1, 2, 3));
    EXPECT_EQ(bounds.size(), Vec3(0));
}

TEST(Bounds, HoldEveryPointAdded) {
    Bounds bounds;
    for (const Vec3& p : {Vec3(1, -2, 0), Vec3(-1, 0, 5), Vec3(0, 4, 1)}) bounds.add(p);
    EXPECT_EQ(bounds.lower, Vec3(-1, -2, 0));
    EXPECT_EQ(bounds.upper, Vec3(1, 4, 5));
    EXPECT_EQ(bounds.centre(), Vec3(0, 1, 2.5f));
}

}  // namespace
}  // namespace vlf
