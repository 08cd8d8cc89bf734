// The limits let equal pictures pass and notice what a mistake would do to one.

#include "golden/picture_difference.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

/// Soft shading with a bright rectangle in it.
Image shadedPicture() {
    Image image(96, 72);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float shade =
                0.05f + 0.004f * static_cast<float>(x) + 0.003f * static_cast<float>(y);
            const bool bright = x > 30 && x < 50 && y > 20 && y < 40;
            image.at(x, y) =
                bright ? Vec3(0.9f, 0.8f, 0.6f) : Vec3(shade, 0.8f * shade, 0.5f * shade);
        }
    return image;
}

bool passes(const Image& picture, const PictureLimits& limits) {
    return within(difference(picture, shadedPicture()), limits);
}

}  // namespace

TEST(PictureLimits, LetEqualPicturesPass) {
    const PictureDifference none = difference(shadedPicture(), shadedPicture());
    EXPECT_EQ(none.mean, 0);
    EXPECT_EQ(none.share, 0);
    EXPECT_EQ(none.flip, 0);
    EXPECT_TRUE(within(none, kDrawing));
}

TEST(PictureLimits, NoticeOnePerCentMoreLight) {
    Image brighter = shadedPicture();
    for (Vec3& p : brighter.pixels) p *= 1.01f;
    EXPECT_FALSE(passes(brighter, kBakedLight));
    EXPECT_EQ(difference(brighter, shadedPicture()).share, 0);
}

TEST(PictureLimits, NoticeAShiftByOnePixel) {
    const Image image = shadedPicture();
    Image shifted = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 1; x < image.width; ++x) shifted.at(x, y) = image.at(x - 1, y);
    EXPECT_FALSE(passes(shifted, kBakedLight));
}

TEST(PictureLimits, NoticeAFewWrongPixels) {
    Image speckled = shadedPicture();
    for (int i = 0; i < 20; ++i) speckled.at(4 * i, 60) *= 1.3f;
    const PictureDifference d = difference(speckled, shadedPicture());
    EXPECT_LT(d.mean, kBakedLight.largest.mean);
    EXPECT_FALSE(within(d, kBakedLight));
}

TEST(PictureLimits, EachIsALimitOnItsOwn) {
    EXPECT_FALSE(within({0.1, 0, 0}, kBakedLight));
    EXPECT_FALSE(within({0, 0.1, 0}, kBakedLight));
    EXPECT_FALSE(within({0, 0, 0.1}, kBakedLight));
    EXPECT_TRUE(within(kBakedLight.largest, kBakedLight));
}

}  // namespace vlf::test
