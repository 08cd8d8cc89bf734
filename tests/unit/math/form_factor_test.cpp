#include "vlf/math/form_factor.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

const Vec3 kUp(0, 0, 1);

/// Form factor from the origin, facing +z, to the square |x|, |y| <= half at height h.
float squareFormFactor(float half, float h) {
    const Vec3 a(-half, -half, h), b(half, -half, h), c(half, half, h), d(-half, half, h);
    return triangleFormFactor(Vec3(0), kUp, a, b, c) + triangleFormFactor(Vec3(0), kUp, a, c, d);
}

TEST(TriangleFormFactor, OfAParallelSquareIsTheClosedForm) {
    for (const float x : {0.1f, 0.5f, 1.0f, 3.0f}) {
        // Four times the view factor of a rectangle with a corner above the point (Howell B-3).
        const float root = std::sqrt(1 + x * x);
        const float expected = 4 * x / (kPi * root) * std::atan(x / root);
        EXPECT_NEAR(squareFormFactor(x, 1), expected, 1e-6f) << x;
        EXPECT_NEAR(squareFormFactor(7 * x, 7), expected, 1e-6f) << x;
    }
}

TEST(TriangleFormFactor, OfAllThatIsAboveTheHorizonIsOne) {
    EXPECT_NEAR(squareFormFactor(1000, 1), 1, 1e-3f);
}

TEST(TriangleFormFactor, IsZeroBelowTheHorizon) {
    EXPECT_EQ(triangleFormFactor(Vec3(0), kUp, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}), 0);
}

TEST(TriangleFormFactor, IgnoresWhichSideFacesThePoint) {
    const Vec3 a(0, 1, 2), b(2, 0, 1), c(1, 2, 3);
    EXPECT_NEAR(triangleFormFactor(Vec3(0), kUp, a, b, c),
                triangleFormFactor(Vec3(0), kUp, a, c, b), 1e-7f);
}

/// The same by sampling: cosine-distributed rays that meet the triangle.
float sampledFormFactor(const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr int kSamples = 200000;
    RandomStream random(1, 0);
    const float volume = glm::dot(a, glm::cross(b, c));
    int hits = 0;
    for (int i = 0; i < kSamples; ++i) {
        const Vec3 d = sampleCosineHemisphere(random.next2());
        hits += glm::dot(d, glm::cross(b, c)) * volume > 0 &&
                glm::dot(d, glm::cross(c, a)) * volume > 0 &&
                glm::dot(d, glm::cross(a, b)) * volume > 0;
    }
    return static_cast<float>(hits) / kSamples;
}

TEST(TriangleFormFactor, ClipsATriangleThatCrossesTheHorizon) {
    const Vec3 oneAbove[3] = {{0, -1, -1}, {2, 0, -0.5f}, {1, 1, 2}};
    const Vec3 twoAbove[3] = {{0, -1, 1}, {2, 0, 0.5f}, {1, 1, -2}};
    for (const auto& t : {oneAbove, twoAbove})
        EXPECT_NEAR(triangleFormFactor(Vec3(0), kUp, t[0], t[1], t[2]),
                    sampledFormFactor(t[0], t[1], t[2]), 4e-3f);
}

}  // namespace
TEST(TriangleFormFactor, TheSurfaceHidesWhatLiesBelowIt) {
    // Of a quad above, the half on the positive side of the tilted surface's plane counts.
    const Vec3 a(-1, -1, 1), b(1, -1, 1), c(1, 1, 1), d(-1, 1, 1);
    const Vec3 tilted(1, 0, 0);
    const float half = triangleFormFactor(Vec3(0), kUp, tilted, a, b, c) +
                       triangleFormFactor(Vec3(0), kUp, tilted, a, c, d);
    EXPECT_NEAR(half, 0.5f * squareFormFactor(1, 1), 1e-6f);
}

}  // namespace vlf
