#include "vlf/display/stereo.h"

#include "vlf/base/error.h"
#include "vlf/math/random.h"
#include "vlf/render/cpu/projection.h"

#include <limits>

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr int kWidth = 400, kHeight = 300;
const Camera kCamera{"test", {1, 2, 3}, {-2, 1, -4}, {0.1f, 1, 0.2f}, 55};

Vec2 seenBy(Eye eye, const EyePair& eyes, const Vec3& point) {
    return Projection(cameraOf(eye, kCamera, eyes), kWidth, kHeight).project(point)->position;
}

/// Left picture less right, pixels.
Vec2 measuredDisparity(const EyePair& eyes, const Vec3& point) {
    return seenBy(Eye::left, eyes, point) - seenBy(Eye::right, eyes, point);
}

/// Points at a depth all over the picture.
std::vector<Vec3> pointsAt(float depth) {
    const Projection middle(kCamera, kWidth, kHeight);
    std::vector<Vec3> points;
    for (const Vec2& place : {Vec2(200, 150), Vec2(20, 30), Vec2(390, 10), Vec2(300, 280)})
        points.push_back(middle.unproject(place, depth));
    return points;
}

TEST(Stereo, DisparityFollowsTheFormulaAndIsLevel) {
    for (const EyePair& eyes : {EyePair{0.064f, {}}, EyePair{0.064f, 2.5f}, EyePair{0.1f, 0.8f}})
        for (const float depth : {0.5f, 1.0f, 2.5f, 6.0f, 50.0f})
            for (const Vec3& point : pointsAt(depth)) {
                const Vec2 d = measuredDisparity(eyes, point);
                EXPECT_NEAR(d.x, disparity(kCamera, eyes, depth, kHeight), 2e-3f);
                EXPECT_NEAR(d.y, 0, 2e-3f);
            }
}

TEST(Stereo, PicturesMeetAtTheConvergenceDistance) {
    for (const Vec3& point : pointsAt(2.5f))
        EXPECT_NEAR(measuredDisparity({0.064f, 2.5f}, point).x, 0, 2e-3f);
    EXPECT_GT(measuredDisparity({0.064f, 2.5f}, pointsAt(1)[0]).x, 1);
    EXPECT_LT(measuredDisparity({0.064f, 2.5f}, pointsAt(10)[0]).x, -1);
}

TEST(Stereo, WithoutConvergenceTheyMeetAtInfinity) {
    EXPECT_NEAR(measuredDisparity({}, pointsAt(1e4f)[0]).x, 0, 5e-2f);
    EXPECT_GT(measuredDisparity({}, pointsAt(1)[0]).x, 10);
}

TEST(Stereo, EyesLookInParallel) {
    const EyePair eyes{0.07f, 1};
    const Camera left = cameraOf(Eye::left, kCamera, eyes);
    const Camera right = cameraOf(Eye::right, kCamera, eyes);
    EXPECT_NEAR(glm::distance(left.eye, right.eye), 0.07f, 1e-6f);
    EXPECT_NEAR(glm::distance(left.look - left.eye, right.look - right.eye), 0, 1e-5f);
    EXPECT_NEAR(glm::distance(0.5f * (left.eye + right.eye), kCamera.eye), 0, 1e-6f);
}

TEST(Stereo, RefusesEyesThatCannotBe) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const EyePair& eyes : {EyePair{-0.1f, {}}, EyePair{nan, {}}, EyePair{0.064f, 0.0f},
                                EyePair{0.064f, -1.0f}, EyePair{0.064f, nan}})
        EXPECT_THROW(cameraOf(Eye::left, kCamera, eyes), InputError);
}

TEST(Stereo, LeftAndRightStandSideBySide) {
    const Image both = sideBySide(Image(3, 2, Vec3(0.25f)), Image(3, 2, Vec3(0.75f)));
    ASSERT_EQ(both.width, 6);
    ASSERT_EQ(both.height, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 6; ++x) EXPECT_EQ(both.at(x, y).x, x < 3 ? 0.25f : 0.75f);
}

TEST(Anaglyph, AFlatGreyStaysAsItIs) {
    for (const float grey : {0.0f, 0.2f, 0.5f, 1.0f}) {
        const Image flat(2, 2, Vec3(grey));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(anaglyph(flat, flat).pixels[0][c], grey, 1e-4f) << grey;
    }
}

TEST(Anaglyph, RedIsOfTheLeftEyeAndCyanOfTheRight) {
    const Image white(1, 1, Vec3(1)), black(1, 1);
    const Vec3 left = anaglyph(white, black).pixels[0], right = anaglyph(black, white).pixels[0];
    EXPECT_GT(left.x, 0.99f);
    EXPECT_EQ(glm::max(left.y, left.z), 0);
    EXPECT_EQ(right.x, 0);
    EXPECT_GT(glm::min(right.y, right.z), 0.99f);
}

TEST(Anaglyph, StaysWithinWhatADisplayShows) {
    RandomStream random(1, 0);
    for (int i = 0; i < 1000; ++i) {
        const auto color = [&] { return Vec3(random.next(), random.next(), random.next()); };
        const Vec3 p = anaglyph(Image(1, 1, color()), Image(1, 1, color())).pixels[0];
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(p[c] >= 0 && p[c] <= 1);
    }
}

}  // namespace
}  // namespace vlf
