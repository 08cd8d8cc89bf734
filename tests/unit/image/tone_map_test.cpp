#include "vlf/image/tone_map.h"

#include "vlf/image/heat_map.h"
#include "vlf/image/srgb.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Srgb, FollowsTheStandard) {
    EXPECT_NEAR(srgbFromLinear(0.5f), 0.735357f, 1e-5f);
    EXPECT_NEAR(linearFromSrgb(0.5f), 0.214041f, 1e-5f);
    EXPECT_NEAR(srgbFromLinear(0.001f), 0.01292f, 1e-7f);
    EXPECT_EQ(linearFromSrgb8(0), 0);
    EXPECT_EQ(linearFromSrgb8(255), 1);
    for (float x = 0; x <= 1; x += 0.01f) EXPECT_NEAR(linearFromSrgb(srgbFromLinear(x)), x, 1e-6f);
}

TEST(Srgb, ClampsWhatCannotBeShown) {
    EXPECT_EQ(srgbFromLinear(-1.0f), 0);
    EXPECT_EQ(srgbFromLinear(3.0f), 1);
    EXPECT_EQ(srgbFromLinear(kInfinity), 1);
    EXPECT_EQ(srgbFromLinear(std::nanf("")), 0);
}

TEST(ToneMap, ClampKeepsWhatFits) {
    EXPECT_EQ(toneMap(Vec3(0.25f, 2, -1), ToneCurve::clamp), Vec3(0.25f, 1, 0));
}

TEST(ToneMap, ExposureIsInStops) {
    const Image image = toneMap(Image(2, 1, Vec3(0.05f)), 3, ToneCurve::clamp);
    EXPECT_FLOAT_EQ(image.at(1, 0).x, 0.4f);
}

TEST(ToneMap, CurvesAreMonotoneAndStayInRange) {
    for (const ToneCurve curve : {ToneCurve::clamp, ToneCurve::filmic}) {
        EXPECT_EQ(toneMap(Vec3(0, -5, std::nanf("")), curve), Vec3(0));
        EXPECT_EQ(toneMap(Vec3(kInfinity), curve), Vec3(1));
        float last = 0;
        for (float x = 1e-4f; x < 1e6f; x *= 1.1f) {
            const float y = toneMap(Vec3(x), curve).x;
            EXPECT_GE(y, last) << "at " << x;
            EXPECT_LE(y, 1);
            last = y;
        }
    }
}

TEST(AutoExposure, BringsTheLogAverageToMiddleGrey) {
    Image image(2, 1);
    image.pixels = {Vec3(1), Vec3(16)};  // log-average 4
    EXPECT_NEAR(4 * std::exp2(autoExposure(image)), 0.18, 1e-6);
}

TEST(AutoExposure, FollowsTheUnits) {
    Image image(2, 1);
    image.pixels = {Vec3(0.3f, 0.1f, 0.2f), Vec3(0.8f)};
    const float before = autoExposure(image);
    for (Vec3& p : image.pixels) p *= 8;
    EXPECT_NEAR(autoExposure(image), before - 3, 1e-5f);
}

TEST(AutoExposure, IgnoresBlackAndBrokenPixels) {
    Image image(4, 1);
    image.pixels = {Vec3(1), Vec3(0), Vec3(1e-20f), Vec3(std::nanf(""))};
    EXPECT_NEAR(autoExposure(image), std::log2(0.18f), 1e-5f);
    EXPECT_EQ(autoExposure(Image(3, 3)), 0);
    EXPECT_EQ(autoExposure(Image()), 0);
}

TEST(HeatMap, GetsBrighterWithTheError) {
    float last = -1;
    for (int i = 0; i <= 100; ++i) {
        const float y = luminance(heatColor(0.01f * static_cast<float>(i)));
        EXPECT_GT(y, last);
        last = y;
    }
    EXPECT_LT(luminance(heatColor(0)), 0.001f);
    EXPECT_GT(luminance(heatColor(1)), 0.8f);
}

TEST(HeatMap, ClampsAndMarksNaNAsWorst) {
    EXPECT_EQ(heatColor(-1), heatColor(0));
    EXPECT_EQ(heatColor(2), heatColor(1));
    EXPECT_EQ(heatColor(std::nanf("")), heatColor(1));
}

TEST(HeatMap, ScalesToWhite) {
    const std::vector<float> values{0, 1, 2, 4};
    const Image image = heatMap(values, 2, 2, 4);
    EXPECT_EQ(image.at(0, 1), heatColor(0.5f));
    EXPECT_EQ(image.at(1, 1), heatColor(1));
    EXPECT_THROW(heatMap(values, 3, 2), std::logic_error);
}

}  // namespace
}  // namespace vlf
