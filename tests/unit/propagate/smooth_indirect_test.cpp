// The filter of the last sweep's noise: noise goes, light stays.

#include "vlf/propagate/smooth_indirect.h"

#include "vlf/math/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace vlf::test {

namespace {

constexpr std::uint32_t kSide = 64, kParts = 8;
constexpr float kSamples = 100;  // of a texel in each part

/// One chart of kSide x kSide texels whose irradiance is a function of (x, y), gathered with
/// noise of the given standard deviation (relative, in the sum of all parts).
struct Gathered {
    Gathered(const std::function<float(int, int)>& irradiance, float noise)
        : parts(kParts, TexelBuffer(size_t{kSide + 2} * (kSide + 2))) {
        unwrap.atlasWidth = unwrap.atlasHeight = kSide + 2;
        RandomStream random(3, 5);
        for (std::uint32_t y = 0; y < kSide; ++y)
            for (std::uint32_t x = 0; x < kSide; ++x) {
                const std::uint32_t texel = (y + 1) * unwrap.atlasWidth + x + 1;
                unwrap.texels.push_back(texel);
                const float truth = irradiance(static_cast<int>(x), static_cast<int>(y));
                expected.push_back(truth);
                for (TexelBuffer& part : parts) {
                    const float error = noise * std::sqrt(12.0f * kParts) * (random.next() - 0.5f);
                    part.set(texel, Vec3(truth / kPi * (1 + error) * kSamples), kSamples);
                }
            }
        sum = sumInOrder(parts);
        smoothed = smoothIndirect(unwrap, parts, sum);
    }

    float raw(std::size_t i) const {
        return kPi * sum.rgb(unwrap.texels[i]).x / sum.weight(unwrap.texels[i]);
    }

    /// Root mean square errors, relative to the mean.
    double rawError() const {
        return error([&](std::size_t i) { return raw(i); });
    }
    double smoothedError() const {
        return error([&](std::size_t i) { return smoothed[i].x; });
    }

    Unwrap unwrap;
    std::vector<TexelBuffer> parts;
    TexelBuffer sum;
    std::vector<float> expected;
    std::vector<Vec3> smoothed;

  private:
    template <class Value>
    double error(Value value) const {
        double squares = 0, mean = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            squares += std::pow(value(i) - expected[i], 2);
            mean += expected[i];
        }
        const auto n = static_cast<double>(expected.size());
        return std::sqrt(squares / n) / (mean / n);
    }
};

}  // namespace

TEST(SmoothIndirect, TakesNoiseOutOfEvenLight) {
    const Gathered g([](int, int) { return 2.0f; }, 0.02f);
    EXPECT_NEAR(g.rawError(), 0.02, 0.002);
    EXPECT_LT(g.smoothedError(), 0.55 * g.rawError());
}

TEST(SmoothIndirect, TakesNoiseOutOfAGradientWithoutBendingIt) {
    const Gathered g([](int x, int y) { return 1 + 0.05f * x + 0.02f * y; }, 0.02f);
    EXPECT_LT(g.smoothedError(), 0.6 * g.rawError());
    double sum = 0, expected = 0;
    for (std::size_t i = 0; i < g.expected.size(); ++i) {
        sum += g.smoothed[i].x;
        expected += g.expected[i];
    }
    EXPECT_NEAR(sum / expected, 1, 1e-3);
}

TEST(SmoothIndirect, LeavesAnEdgeAlone) {
    const Gathered g([](int x, int) { return x < 32 ? 1.0f : 0.0f; }, 0.02f);
    for (std::size_t i = 0; i < g.expected.size(); ++i) {
        if (g.expected[i] == 0) {
            ASSERT_EQ(g.smoothed[i].x, 0) << "light leaks into the dark";
        }
        ASSERT_NEAR(g.smoothed[i].x, g.expected[i], 0.1f);
    }
}

TEST(SmoothIndirect, ChangesNothingWhereThereIsNoNoise) {
    const Gathered g([](int x, int y) { return 2 + std::sin(0.4f * x) * std::cos(0.3f * y); }, 0);
    for (std::size_t i = 0; i < g.expected.size(); ++i)
        ASSERT_NEAR(g.smoothed[i].x, g.raw(i), 1e-4f);
}

TEST(SmoothIndirect, TexelsNoRayHasMetStayBlackAndDoNoHarm) {
    Gathered g([](int, int) { return 2.0f; }, 0.02f);
    const std::uint32_t missed = g.unwrap.texels[10 * kSide + 10];
    for (TexelBuffer& part : g.parts) part.set(missed, Vec3(0), 0);
    const std::vector<Vec3> smoothed = smoothIndirect(g.unwrap, g.parts, sumInOrder(g.parts));
    EXPECT_EQ(smoothed[10 * kSide + 10], Vec3(0));
    EXPECT_NEAR(smoothed[10 * kSide + 11].x, 2, 0.2f);
}

}  // namespace vlf::test
