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
                unwrap.texelChart.push_back(0);
                const float truth = irradiance(static_cast<int>(x), static_cast<int>(y));
                expected.push_back(truth);
                for (TexelBuffer& part : parts) {
                    const float error = noise * std::sqrt(12.0f * kParts) * (random.next() - 0.5f);
                    part.set(texel, Vec3(truth / kPi * (1 + error) * kSamples), kSamples);
                }
            }
        sum = smoothed = sumInOrder(parts);
    }

    void smooth() { smoothIndirect(unwrap, parts, smoothed); }

    float raw(std::size_t i) const { return irradiance(sum, i); }
    float result(std::size_t i) const { return irradiance(smoothed, i); }

    /// Root mean square errors, relative to the mean.
    double rawError() const {
        return error([&](std::size_t i) { return raw(i); });
    }
    double smoothedError() const {
        return error([&](std::size_t i) { return result(i); });
    }

    Unwrap unwrap;
    std::vector<TexelBuffer> parts;
    TexelBuffer sum, smoothed;
    std::vector<float> expected;

  private:
    float irradiance(const TexelBuffer& buffer, std::size_t i) const {
        return kPi * buffer.rgb(unwrap.texels[i]).x / buffer.weight(unwrap.texels[i]);
    }

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
    Gathered g([](int, int) { return 2.0f; }, 0.02f);
    g.smooth();
    EXPECT_NEAR(g.rawError(), 0.02, 0.002);
    EXPECT_LT(g.smoothedError(), 0.55 * g.rawError());
}

TEST(SmoothIndirect, TakesNoiseOutOfAGradientWithoutBendingIt) {
    Gathered g([](int x, int y) { return 1 + 0.05f * x + 0.02f * y; }, 0.02f);
    g.smooth();
    EXPECT_LT(g.smoothedError(), 0.6 * g.rawError());
    double sum = 0, expected = 0;
    for (std::size_t i = 0; i < g.expected.size(); ++i) {
        sum += g.result(i);
        expected += g.expected[i];
    }
    EXPECT_NEAR(sum / expected, 1, 1e-3);
}

TEST(SmoothIndirect, LeavesAnEdgeAlone) {
    Gathered g([](int x, int) { return x < 32 ? 1.0f : 0.0f; }, 0.02f);
    g.smooth();
    for (std::size_t i = 0; i < g.expected.size(); ++i) {
        if (g.expected[i] == 0) {
            ASSERT_EQ(g.result(i), 0) << "light leaks into the dark";
        }
        ASSERT_NEAR(g.result(i), g.expected[i], 0.1f);
    }
}

TEST(SmoothIndirect, ChangesNothingWhereThereIsNoNoise) {
    Gathered g([](int x, int y) { return 2 + std::sin(0.4f * x) * std::cos(0.3f * y); }, 0);
    g.smooth();
    for (std::size_t i = 0; i < g.expected.size(); ++i) ASSERT_NEAR(g.result(i), g.raw(i), 1e-4f);
}

TEST(SmoothIndirect, TexelsNoRayHasMetDoNoHarm) {
    Gathered g([](int, int) { return 2.0f; }, 0.02f);
    const std::size_t missed = 10 * kSide + 10;
    for (TexelBuffer& part : g.parts) part.set(g.unwrap.texels[missed], Vec3(0), 0);
    g.smoothed.set(g.unwrap.texels[missed], Vec3(0), 0);
    g.smooth();
    EXPECT_EQ(g.smoothed.weight(g.unwrap.texels[missed]), 0);
    EXPECT_NEAR(g.result(missed + 1), 2, 0.2f);
}

TEST(SmoothIndirect, ReachesNeitherIntoOtherChartsNorBeyondAGap) {
    Gathered g([](int x, int) { return x < 32 ? 1.0f : x == 32 ? 0.0f : 1.02f; }, 0.02f);
    // The texels of x = 32 are of another chart: from 31 to 33 there is no way.
    for (std::size_t i = 0; i < g.unwrap.texels.size(); ++i)
        g.unwrap.texelChart[i] = i % kSide == 32;
    g.smooth();
    double left = 0, right = 0;
    for (std::size_t y = 0; y < kSide; ++y) {
        left += g.result(y * kSide + 31) / kSide;
        right += g.result(y * kSide + 33) / kSide;
        ASSERT_EQ(g.result(y * kSide + 32), 0);
    }
    EXPECT_NEAR(left, 1, 0.006);
    EXPECT_NEAR(right, 1.02, 0.006);
}

}  // namespace vlf::test
