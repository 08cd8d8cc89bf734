#include "vlf/math/sampling.h"

#include "vlf/math/random.h"

#include "support/chi_square.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr int kSamples = 200000, kRows = 16, kColumns = 32;

/// Bins directions by cos(theta) and phi, cells of equal solid angle, and compares with the
/// integral of `density` over each cell.
double directionDeviation(const std::function<Vec3(RandomStream&)>& sample,
                          const std::function<double(double cosTheta)>& density) {
    constexpr int kSteps = 64;
    std::vector<double> observed(kRows * kColumns, 0.0), expected;
    RandomStream random(1, 0);
    for (int i = 0; i < kSamples; ++i) {
        const Vec3 d = sample(random);
        EXPECT_NEAR(glm::length(d), 1, 1e-5f);
        const float turn = std::atan2(d.y, d.x) / (2 * kPi) + 0.5f;
        const int row = std::clamp(static_cast<int>((d.z + 1) / 2 * kRows), 0, kRows - 1);
        ++observed[row * kColumns + std::min(static_cast<int>(turn * kColumns), kColumns - 1)];
    }
    for (int row = 0; row < kRows; ++row) {
        double sum = 0;
        for (int s = 0; s < kSteps; ++s)
            sum += density((row + (s + 0.5) / kSteps) * 2 / kRows - 1) / kSteps;
        expected.insert(expected.end(), kColumns, kSamples * sum * 4 * kPi / observed.size());
    }
    for (std::size_t i = observed.size(); i-- > 0;)
        if (expected[i] == 0) {
            EXPECT_EQ(observed[i], 0) << "a sample where the density is zero";
            observed.erase(observed.begin() + i);
            expected.erase(expected.begin() + i);
        }
    return test::chiSquareDeviation(observed, expected);
}

TEST(Sampling, CosineHemisphereHasItsDensity) {
    EXPECT_LT(
        directionDeviation([](RandomStream& r) { return sampleCosineHemisphere(r.next2()); },
                           [](double c) { return cosineHemisphereDensity(static_cast<float>(c)); }),
        4);
}

TEST(Sampling, UniformSphereHasItsDensity) {
    EXPECT_LT(directionDeviation([](RandomStream& r) { return sampleUniformSphere(r.next2()); },
                                 [](double) { return 1 / (4 * kPi); }),
              4);
}

TEST(Sampling, UniformRotationTakesAnyDirectionAnywhereAlike) {
    for (const Vec3& d : {Vec3(0, 0, 1), Vec3(0, 1, 0), glm::normalize(Vec3(1, -2, 3))})
        EXPECT_LT(directionDeviation(
                      [&](RandomStream& r) {
                          const Vec2 u = r.next2();
                          return sampleUniformRotation({u.x, u.y, r.next()}) * d;
                      },
                      [](double) { return 1 / (4 * kPi); }),
                  4);
}

TEST(Sampling, UniformRotationIsARotation) {
    RandomStream random(2, 0);
    for (int i = 0; i < 1000; ++i) {
        const Vec2 u = random.next2();
        const Mat3 r = sampleUniformRotation({u.x, u.y, random.next()});
        const Mat3 identity = glm::transpose(r) * r;
        for (int c = 0; c < 3; ++c) EXPECT_LT(glm::distance(identity[c], Mat3(1)[c]), 1e-5f);
        EXPECT_NEAR(glm::determinant(r), 1, 1e-5f);
    }
}

TEST(Sampling, UniformTriangleFillsEqualAreasAlike) {
    // Barycentric cells (i, j) of side 1 / n split into two triangles of equal area.
    constexpr int n = 16;
    std::vector<double> observed(n * n, 0.0);
    RandomStream random(3, 0);
    for (int k = 0; k < kSamples; ++k) {
        const Vec2 b = sampleUniformTriangle(random.next2());
        ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1 + 1e-6f) << b.x << ' ' << b.y;
        const int i = std::min(static_cast<int>(b.x * n), n - 1);
        const int j = std::min(static_cast<int>(b.y * n), n - 1 - i);
        const bool upper = b.x * n - i + b.y * n - j > 1 && i + j < n - 1;
        // Row i holds 2 (n - i) - 1 triangles; n² in all.
        ++observed[i * (2 * n - i) + 2 * j + upper];
    }
    const std::vector<double> expected(observed.size(), kSamples / static_cast<double>(n * n));
    EXPECT_LT(test::chiSquareDeviation(observed, expected), 4);
}

}  // namespace
}  // namespace vlf
