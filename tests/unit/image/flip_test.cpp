// The numbers called known come from the definition evaluated in double precision with filters of
// two dimensions. The authors' implementation (flip-evaluator 1.7) agrees within 6e-5 on the means
// and 1.5e-4 per pixel; flip_crosscheck.py compares with it on larger pictures.

#include "vlf/image/flip.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/image/convolution.h"
#include "vlf/image/srgb.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace vlf {
namespace {

Image grey(int size, float encoded) {
    return Image(size, size, Vec3(linearFromSrgb(encoded)));
}

Image ramps(bool swapped) {
    Image image(32, 24);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            Vec3 encoded(x * 8 % 256, y * 10 % 256, (x + y) * 4 % 256);
            if (swapped) std::swap(encoded.x, encoded.z);
            image.at(x, y) = linearFromSrgb(encoded / 255.0f);
        }
    return image;
}

TEST(Flip, IsZeroForEqualImages) {
    const FlipResult result = flip(ramps(false), ramps(false));
    EXPECT_EQ(result.mean, 0);
    EXPECT_EQ(*std::max_element(result.error.begin(), result.error.end()), 0);
}

TEST(Flip, OfFlatColoursIsKnown) {
    // The square root in the feature error amplifies rounding of what should be 0 to about 6e-5.
    EXPECT_NEAR(flip(grey(8, 0.6f), grey(8, 0.5f)).mean, 0.285013, 1e-4);
    EXPECT_NEAR(flip(grey(8, 1), grey(8, 0)).mean, 0.967380, 1e-4);
    EXPECT_NEAR(flip(Image(8, 8, {0, 1, 0}), Image(8, 8, {0, 0, 1})).mean, 1, 1e-6);
}

TEST(Flip, OfRampsIsKnownPerPixel) {
    const FlipResult result = flip(ramps(true), ramps(false));
    EXPECT_NEAR(result.mean, 0.386582, 5e-6);
    EXPECT_NEAR(result.error[3 * 32 + 5], 0.100710, 5e-6);
    EXPECT_NEAR(result.error[20 * 32 + 30], 0.544953, 5e-6);
    EXPECT_NEAR(result.error[12 * 32 + 16], 0.254947, 5e-6);
}

TEST(Flip, OfADotIsKnownAndSymmetric) {
    Image dot(33, 33);
    dot.at(16, 16) = Vec3(1);
    const FlipResult result = flip(Image(33, 33), dot);
    EXPECT_NEAR(result.mean, 0.0131379, 1e-6);
    EXPECT_NEAR(result.error[16 * 33 + 16], 0.865049, 2e-6);
    EXPECT_NEAR(result.error[16 * 33 + 20], 0.0179793, 2e-6);
    EXPECT_NEAR(result.error[12 * 33 + 16], 0.0179793, 2e-6);
    EXPECT_NEAR(flip(dot, Image(33, 33)).mean, result.mean, 1e-7) << "order must not matter";
}

TEST(Flip, FineDetailMattersLessFromAfar) {
    Image checker(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) checker.at(x, y) = Vec3(static_cast<float>((x + y) % 2));
    const Image flat(64, 64, Vec3(0.5f));
    EXPECT_LT(flip(checker, flat, 100).mean, 0.5 * flip(checker, flat, 10).mean);
}

TEST(Flip, ClampsToTheRangeOfADisplay) {
    EXPECT_EQ(flip(Image(4, 4, Vec3(9)), Image(4, 4, Vec3(1))).mean, 0);
    EXPECT_EQ(flip(Image(4, 4, Vec3(-9)), Image(4, 4)).mean, 0);
}

TEST(Flip, MeanIsOverTheMask) {
    const FlipResult whole = flip(ramps(true), ramps(false));
    std::vector<std::uint8_t> mask(whole.error.size(), 0);
    mask[100] = mask[200] = 1;
    const FlipResult masked = flip(ramps(true), ramps(false), kFlipPixelsPerDegree, mask);
    EXPECT_NEAR(masked.mean, 0.5 * (whole.error[100] + whole.error[200]), 1e-7);
    EXPECT_EQ(masked.error, whole.error);
}

TEST(Flip, IsTheSameForAnyNumberOfThreads) {
    const FlipResult several = flip(ramps(true), ramps(false));
    const ThreadLimit limit(1);
    EXPECT_EQ(flip(ramps(true), ramps(false)).error, several.error);
}

TEST(Flip, WorksOnOnePixel) {
    EXPECT_NEAR(flip(grey(1, 0.6f), grey(1, 0.5f)).mean, 0.285013, 1e-4);
}

TEST(Flip, RejectsBadArguments) {
    EXPECT_THROW(flip(Image(2, 2), Image(3, 2)), InputError);
    EXPECT_THROW(flip(Image(2, 2), Image(2, 2), 0.0f), InputError);
    EXPECT_THROW(flip(Image(2, 2), Image(2, 2), std::nanf("")), InputError);
}

TEST(Convolution, FollowsItsDefinitionWithBordersRepeated) {
    Plane plane(4, 3);
    for (std::size_t i = 0; i < plane.values.size(); ++i)
        plane.values[i] = static_cast<float>(i * i);
    const Kernel kernel{1, 10, 100, 1000, 10000};
    const Plane rows = filterRows(plane, kernel), columns = filterColumns(plane, kernel);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) {
            float inRow = 0, inColumn = 0;
            for (int i = -2; i <= 2; ++i) {
                inRow += kernel[i + 2] * plane.values[y * 4 + std::clamp(x + i, 0, 3)];
                inColumn += kernel[i + 2] * plane.values[std::clamp(y + i, 0, 2) * 4 + x];
            }
            EXPECT_FLOAT_EQ(rows.values[y * 4 + x], inRow);
            EXPECT_FLOAT_EQ(columns.values[y * 4 + x], inColumn);
        }
}

}  // namespace
}  // namespace vlf
