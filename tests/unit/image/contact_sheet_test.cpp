#include "vlf/image/contact_sheet.h"

#include "vlf/base/error.h"

#include <vector>

#include <gtest/gtest.h>

namespace vlf {
namespace {

const Vec3 kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1), kGrey(0.25f);

TEST(Resized, KeepsTheMeanWhenItShrinks) {
    Image checks(7, 5);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) checks.at(x, y) = Vec3((x + y) % 2);
    const Vec3 mean = resized(checks, 1, 1).at(0, 0);
    EXPECT_NEAR(mean.x, 17.0f / 35, 1e-6f);
    const Image small = resized(checks, 3, 2);
    Vec3 sum(0);
    for (const Vec3& p : small.pixels) sum += p;
    EXPECT_NEAR(sum.x / 6, 17.0f / 35, 1e-6f);
}

TEST(Resized, ToTheSameSizeChangesNothing) {
    Image image(4, 3, kGrey);
    image.at(2, 1) = kRed;
    EXPECT_EQ(resized(image, 4, 3).pixels, image.pixels);
}

TEST(Resized, EnlargesByRepeating) {
    Image image(2, 1, kRed);
    image.at(1, 0) = kBlue;
    const Image large = resized(image, 4, 2);
    EXPECT_EQ(large.at(1, 1), kRed);
    EXPECT_EQ(large.at(2, 1), kBlue);
}

TEST(ContactSheet, PlacesPicturesInReadingOrder) {
    const std::vector<Image> pictures{Image(8, 4, kRed), Image(8, 4, kGreen), Image(8, 4, kBlue)};
    const Image sheet = contactSheet(pictures, {2, 4, 1, kGrey});
    EXPECT_EQ(sheet.width, 2 * (4 + 1) + 1);
    EXPECT_EQ(sheet.height, 2 * (2 + 1) + 1);
    EXPECT_EQ(sheet.at(0, 0), kGrey);
    EXPECT_EQ(sheet.at(1, 1), kRed);
    EXPECT_EQ(sheet.at(6, 1), kGreen);
    EXPECT_EQ(sheet.at(1, 4), kBlue);
    EXPECT_EQ(sheet.at(6, 4), kGrey);
}

TEST(ContactSheet, CentresAPictureOfOtherProportions) {
    const std::vector<Image> pictures{Image(8, 4, kRed), Image(4, 4, kGreen)};
    const Image sheet = contactSheet(pictures, {2, 8, 0, kGrey});
    EXPECT_EQ(sheet.at(9, 0), kGrey);
    EXPECT_EQ(sheet.at(10, 0), kGreen);
    EXPECT_EQ(sheet.at(13, 3), kGreen);
    EXPECT_EQ(sheet.at(14, 3), kGrey);
}

TEST(ContactSheet, RejectsWhatCannotBeShown) {
    EXPECT_THROW(contactSheet({}), InputError);
    const std::vector<Image> empty{Image()};
    EXPECT_THROW(contactSheet(empty), InputError);
    const std::vector<Image> tall{Image(1, 100000)};
    EXPECT_THROW(contactSheet(tall), InputError);
}

}  // namespace
}  // namespace vlf
