#include "vlf/propagate/indirect_noise.h"
#include "vlf/math/random.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

constexpr std::size_t kTexels = 400, kParts = 8;
constexpr double kLines = 513;

/// Of texels with so many samples of each line, every other one with a tenth of them, whose parts
/// all differ alike: by a tenth of the radiance 1.
std::vector<float> varianceOf(double samplesPerLine) {
    Unwrap unwrap;
    std::vector<TexelBuffer> parts(kParts, TexelBuffer(kTexels));
    RandomStream random(1, 2);
    for (std::uint32_t t = 0; t < kTexels; ++t) {
        unwrap.texels.push_back(t);
        const auto weight =
            static_cast<float>(samplesPerLine * (t % 2 ? 0.1 : 1) * kLines / kParts);
        for (TexelBuffer& part : parts)
            part.set(t, Vec3(weight * (random.next() < 0.5f ? 0.9f : 1.1f)), weight);
    }
    return indirectVariance(unwrap, parts, sumInOrder(parts), {kLines, 1, false});
}

/// Of the even or the odd texels.
double mean(const std::vector<float>& values, std::size_t first) {
    double sum = 0;
    for (std::size_t i = first; i < values.size(); i += 2) sum += values[i];
    return 2 * sum / static_cast<double>(values.size());
}

}  // namespace

TEST(IndirectNoise, OfTexelsWithFewSamplesOfALineIsTheSpreadOfTheParts) {
    // Three channels; the variance of a mean of eight.
    const double ofIndependent = 3 * kPi * kPi * 0.1 * 0.1 / kParts;
    EXPECT_NEAR(mean(varianceOf(0.2), 1) / ofIndependent, 1, 0.05);
}

TEST(IndirectNoise, IsTheLessTheMoreSamplesALineHasInATexel) {
    const std::vector<float> some = varianceOf(0.2), many = varianceOf(2);
    EXPECT_LT(mean(some, 0), 0.6 * mean(some, 1));
    EXPECT_LT(mean(many, 0), 0.3 * mean(some, 0));
}

}  // namespace vlf::test
