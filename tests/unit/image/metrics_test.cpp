#include "vlf/image/metrics.h"

#include "vlf/base/error.h"
#include "vlf/image/srgb.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace vlf {
namespace {

Image imageOf(int width, int height, std::vector<Vec3> pixels) {
    Image image(width, height);
    image.pixels = std::move(pixels);
    return image;
}

using Metric = double (*)(const Image&, const Image&, PixelMask);
constexpr Metric kMetrics[] = {relativeMse, relativeRmse, peakSignalToNoise};

TEST(Metrics, EqualImagesHaveNoError) {
    const Image image = imageOf(2, 1, {{0.1f, 2, 0}, {5, 0.7f, 0.3f}});
    EXPECT_EQ(relativeMse(image, image), 0);
    EXPECT_EQ(relativeRmse(image, image), 0);
    EXPECT_EQ(peakSignalToNoise(image, image), std::numeric_limits<double>::infinity());
}

TEST(Metrics, RelativeMseDividesByTheSquaredReference) {
    const Image reference = imageOf(2, 1, {{1, 0, 2}, {3, 3, 3}});
    const Image test = imageOf(2, 1, {{1.5f, 0.1f, 2}, {3, 3, 2}});
    const double expected = (0.25 / 1.01 + 0.01 / 0.01 + 1 / 9.01) / 6;
    EXPECT_NEAR(relativeMse(test, reference), expected, 1e-7);
}

TEST(Metrics, RelativeRmseIsIndependentOfUnits) {
    const Image reference = imageOf(2, 1, {{1, 2, 3}, {0, 4, 1}});
    const Image test = imageOf(2, 1, {{2, 2, 3}, {0, 4, 3}});
    EXPECT_NEAR(relativeRmse(test, reference), std::sqrt(5.0 / 31), 1e-12);
    Image brightTest = test, brightReference = reference;
    for (Vec3& p : brightTest.pixels) p *= 1024.0f;
    for (Vec3& p : brightReference.pixels) p *= 1024.0f;
    EXPECT_DOUBLE_EQ(relativeRmse(brightTest, brightReference), relativeRmse(test, reference));
}

TEST(Metrics, RelativeRmseOfABlackReferenceIsInfinite) {
    EXPECT_EQ(relativeRmse(Image(1, 1, Vec3(1)), Image(1, 1)),
              std::numeric_limits<double>::infinity());
    EXPECT_EQ(relativeRmse(Image(1, 1), Image(1, 1)), 0);
}

TEST(Metrics, PsnrIsOfClampedAndEncodedValues) {
    const Image reference(3, 3, Vec3(linearFromSrgb(0.5f)));
    const Image test(3, 3, Vec3(linearFromSrgb(0.6f)));
    EXPECT_NEAR(peakSignalToNoise(test, reference), 20, 1e-4);
    const Image white(3, 3, Vec3(1)), brighter(3, 3, Vec3(100));
    EXPECT_EQ(peakSignalToNoise(brighter, white), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(peakSignalToNoise(Image(3, 3), white), 0, 1e-6);
}

TEST(Metrics, MaskSelectsPixels) {
    const Image reference = imageOf(2, 1, {{1, 1, 1}, {1, 1, 1}});
    const Image test = imageOf(2, 1, {{1, 1, 1}, {2, 2, 2}});
    const std::vector<std::uint8_t> left{1, 0}, right{0, 255};
    EXPECT_EQ(relativeMse(test, reference, left), 0);
    EXPECT_NEAR(relativeMse(test, reference, right), 1 / 1.01, 1e-9);
    EXPECT_EQ(relativeRmse(test, reference, right), 1);
    EXPECT_EQ(peakSignalToNoise(test, reference, left), std::numeric_limits<double>::infinity());
}

TEST(Metrics, RejectImagesThatCannotBeCompared) {
    const std::vector<std::uint8_t> nothing{0, 0, 0, 0}, tooShort{1, 1};
    for (const Metric metric : kMetrics) {
        EXPECT_THROW(metric(Image(2, 2), Image(2, 3), {}), InputError);
        EXPECT_THROW(metric(Image(4, 1), Image(2, 2), {}), InputError);
        EXPECT_THROW(metric(Image(), Image(), {}), InputError);
        EXPECT_THROW(metric(Image(2, 2), Image(2, 2), nothing), InputError);
        EXPECT_THROW(metric(Image(2, 2), Image(2, 2), tooShort), InputError);
    }
}

TEST(Metrics, FindPixelsThatAreNotFinite) {
    Image image(3, 2);
    EXPECT_TRUE(nonFinitePixels(image).empty());
    image.at(1, 0).y = std::numeric_limits<float>::quiet_NaN();
    image.at(2, 1).z = -std::numeric_limits<float>::infinity();
    EXPECT_EQ(nonFinitePixels(image), (std::vector<std::size_t>{1, 5}));
}

}  // namespace
}  // namespace vlf
