// The estimated noise of indirect light: jumps between neighbouring directions are noise, slow
// changes are not.

#include "vlf/propagate/indirect_noise.h"

#include "vlf/math/random.h"
#include "vlf/propagate/bake_solution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace vlf::test {

namespace {

constexpr std::size_t kTexels = 4000;
constexpr float kWeight = 20;  // samples of a texel in a part

/// Mean over texels that have gathered radiance 1 + deviation(texel, part).
double meanVariance(const std::function<float(std::uint32_t, std::size_t)>& deviation,
                    bool turned = false) {
    Unwrap unwrap;
    std::vector<TexelBuffer> parts(kAccumulators, TexelBuffer(kTexels));
    for (std::uint32_t t = 0; t < kTexels; ++t) {
        unwrap.texels.push_back(t);
        for (std::size_t a = 0; a < kAccumulators; ++a)
            parts[a].set(t, Vec3(kWeight * (1 + deviation(t, a))), kWeight);
    }
    double sum = 0;
    for (const float v : indirectVariance(unwrap, parts, sumInOrder(parts), turned)) sum += v;
    return sum / kTexels;
}

float jump(RandomStream& random) {
    return random.next() < 0.5f ? -0.1f : 0.1f;
}

/// Three channels of the mean of so many parts.
constexpr double kOfJumps = 3 * kPi * kPi * 0.1 * 0.1 / kAccumulators;

}  // namespace

TEST(IndirectNoise, OfPartsThatJumpIsTheirSpread) {
    RandomStream random(1, 2);
    EXPECT_NEAR(meanVariance([&](auto, auto) { return jump(random); }) / kOfJumps, 1, 0.05);
}

TEST(IndirectNoise, OfTurnedSetsIsLess) {
    RandomStream random(1, 2);
    const double variance = meanVariance([&](auto, auto) { return jump(random); }, true);
    EXPECT_GT(variance, 0.3 * kOfJumps);
    EXPECT_LT(variance, 0.7 * kOfJumps);
}

TEST(IndirectNoise, IsNotWhatChangesSlowlyFromPartToPart) {
    const auto slow = [](std::uint32_t t, std::size_t a) {
        return 0.1f * std::cos(2 * kPi * (static_cast<float>(a) / kAccumulators + 0.37f * t));
    };
    EXPECT_LT(meanVariance(slow), 1e-3 * kOfJumps);
}

TEST(IndirectNoise, OfTexelsWithRaysOfTheirOwnIsThatOfSamplesElsewhere) {
    Unwrap unwrap;
    std::vector<TexelBuffer> parts(kAccumulators, TexelBuffer(kTexels));
    RandomStream random(3, 4);
    for (std::uint32_t t = 0; t < kTexels; ++t) {
        unwrap.texels.push_back(t);
        for (TexelBuffer& part : parts)
            if (t % 2 == 0) part.set(t, Vec3(kWeight * (1 + jump(random))), kWeight);
    }
    TexelBuffer gathered = sumInOrder(parts);
    const float own = 2 * kWeight;
    for (std::uint32_t t = 1; t < kTexels; t += 2) gathered.set(t, Vec3(3 * own), own);
    const std::vector<float> variance = indirectVariance(unwrap, parts, gathered, false);
    // Of three times the radiance and a quarter of the samples.
    EXPECT_NEAR(variance[1] / kOfJumps, 9 * 4, 0.1 * 36);
}

}  // namespace vlf::test
