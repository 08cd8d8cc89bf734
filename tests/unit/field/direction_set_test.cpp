#include "vlf/field/direction_set.h"

#include "vlf/base/error.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// Random directions, every fourth one on a coordinate plane and every 40th on an axis, where the
/// octants meet.
Vec3 testDirection(RandomStream& random, int i) {
    Vec3 d = sampleUniformSphere(random.next2());
    if (i % 4 == 0) d[i / 4 % 3] = 0;
    if (i % 40 == 0) d[(i / 4 + 1) % 3] = 0;
    return glm::normalize(d);
}

float largestDot(const DirectionSet& set, const Vec3& d) {
    float largest = -2;
    for (int i = 0; i < set.directionCount(); ++i)
        largest = std::max(largest, glm::dot(d, set.direction(i)));
    return largest;
}

/// Weight of every direction that counts at d, for comparing triples of different corner order.
std::map<std::uint32_t, float> weightsAt(const DirectionSet& set, const Vec3& d) {
    const DirectionTriple triple = set.triple(d);
    std::map<std::uint32_t, float> weights;
    for (int i = 0; i < 3; ++i) weights[triple.index[i]] += triple.weight[i];
    return weights;
}

/// Largest change of any direction's weight from a to b.
float weightChange(const DirectionSet& set, const Vec3& a, const Vec3& b) {
    std::map<std::uint32_t, float> difference = weightsAt(set, a);
    for (const auto& [index, weight] : weightsAt(set, b)) difference[index] -= weight;
    float largest = 0;
    for (const auto& [index, change] : difference) largest = std::max(largest, std::abs(change));
    return largest;
}

class DirectionSetTest : public testing::TestWithParam<int> {
  protected:
    const DirectionSet set_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Sizes, DirectionSetTest, testing::Values(3, 9, 33, 129, 513, 2049, 8193),
                         testing::PrintToStringParamName());

TEST(DirectionSet, RejectsLineCountsThatNoSubdivisionGives) {
    for (const int lines : {-1, 0, 1, 2, 100, 128, 512, 2048, 524289})
        EXPECT_THROW(DirectionSet{lines}, InputError) << lines;
}

TEST_P(DirectionSetTest, HasTheLinesAskedForEachInBothSenses) {
    EXPECT_EQ(set_.lineCount(), GetParam());
    EXPECT_EQ(set_.directionCount(), 2 * GetParam());
    for (int i = 0; i < set_.directionCount(); ++i) {
        EXPECT_NEAR(glm::length(set_.direction(i)), 1.0f, 1e-6f);
        EXPECT_EQ(set_.direction(set_.opposite(i)), -set_.direction(i));
        EXPECT_EQ(set_.opposite(set_.opposite(i)), static_cast<std::uint32_t>(i));
        EXPECT_EQ(set_.weight(i), set_.weight(set_.opposite(i)));
    }
}

TEST_P(DirectionSetTest, EachDirectionIsItsOwnNearest) {
    for (int i = 0; i < set_.directionCount(); ++i)
        EXPECT_EQ(set_.nearest(set_.direction(i)), static_cast<std::uint32_t>(i));
}

TEST_P(DirectionSetTest, NearestHasTheLargestDotProductOfAll) {
    const int queries = std::min(100000, 200'000'000 / set_.directionCount());
    RandomStream random(1, GetParam());
    for (int i = 0; i < queries; ++i) {
        const Vec3 d = testDirection(random, i);
        ASSERT_EQ(glm::dot(d, set_.direction(set_.nearest(d))), largestDot(set_, d))
            << d.x << ' ' << d.y << ' ' << d.z;
    }
}

TEST_P(DirectionSetTest, NearestOfTheOppositeIsTheOpposite) {
    RandomStream random(2, GetParam());
    for (int i = 0; i < 10000; ++i) {
        const Vec3 d = sampleUniformSphere(random.next2());
        EXPECT_EQ(set_.nearest(-d), set_.opposite(set_.nearest(d)));
    }
}

TEST_P(DirectionSetTest, TripleWeightsAreAConvexCombinationThatGivesTheDirection) {
    RandomStream random(3, GetParam());
    for (int i = 0; i < 100000; ++i) {
        const Vec3 d = testDirection(random, i);
        const DirectionTriple triple = set_.triple(d);
        Vec3 sum(0);
        for (int k = 0; k < 3; ++k) {
            ASSERT_GE(triple.weight[k], 0.0f);
            sum += triple.weight[k] * set_.direction(triple.index[k]);
        }
        ASSERT_NEAR(triple.weight.x + triple.weight.y + triple.weight.z, 1.0f, 1e-6f);
        ASSERT_LT(glm::distance(glm::normalize(sum), d), 5e-7f) << d.x << ' ' << d.y << ' ' << d.z;
    }
}

TEST_P(DirectionSetTest, TripleHoldsTheNearestDirection) {
    RandomStream random(4, GetParam());
    for (int i = 0; i < 10000; ++i) {
        const Vec3 d = sampleUniformSphere(random.next2());
        const DirectionTriple triple = set_.triple(d);
        EXPECT_EQ(std::ranges::count(triple.index, set_.nearest(d)), 1);
    }
}

TEST_P(DirectionSetTest, TripleWeightIsOneAtAVertex) {
    for (int i = 0; i < set_.directionCount(); ++i) {
        const auto weights = weightsAt(set_, set_.direction(i));
        ASSERT_TRUE(weights.contains(i));
        EXPECT_EQ(weights.at(i), 1.0f);
    }
}

TEST_P(DirectionSetTest, TripleIsContinuousAcrossEveryEdge) {
    // A step of 1e-5 changes a weight by at most about the step over the triangle's height.
    constexpr float kStep = 1e-5f;
    const float bound = 4 * kStep * std::sqrt(static_cast<float>(GetParam())) + 1e-4f;
    RandomStream random(5, GetParam());
    for (int i = 0; i < 20000; ++i) {
        const Vec3 middle = testDirection(random, i);
        const Vec3 side = kStep * sampleUniformSphere(random.next2());
        ASSERT_LT(weightChange(set_, glm::normalize(middle - side), glm::normalize(middle + side)),
                  bound)
            << middle.x << ' ' << middle.y << ' ' << middle.z;
    }
}

TEST_P(DirectionSetTest, TripleIsContinuousAcrossTheEquator) {
    for (int i = 0; i < 1000; ++i) {
        const float phi = 2 * kPi * i / 1000;
        const Vec3 above(std::cos(phi), 1e-7f, std::sin(phi)), below(above.x, -1e-7f, above.z);
        ASSERT_LT(weightChange(set_, above, below), 1e-4f) << phi;
    }
}

TEST_P(DirectionSetTest, WeightsAreTheSolidAnglesOfTheNearestCells) {
    double sum = 0;
    for (int i = 0; i < set_.directionCount(); ++i) sum += set_.weight(i);
    EXPECT_NEAR(sum, 4 * kPi, 1e-5);
    if (set_.lineCount() > 129) return;  // the Monte Carlo estimate of a cell gets too noisy

    constexpr int kSamples = 2'000'000;
    std::vector<int> count(set_.directionCount(), 0);
    RandomStream random(6, GetParam());
    for (int i = 0; i < kSamples; ++i) ++count[set_.nearest(sampleUniformSphere(random.next2()))];
    for (int i = 0; i < set_.directionCount(); ++i) {
        const double expected = kSamples * set_.weight(i) / (4 * kPi);
        EXPECT_NEAR(count[i], expected, 5 * std::sqrt(expected)) << i;
    }
}

TEST_P(DirectionSetTest, WeightsAreNearlyEqual) {
    if (set_.lineCount() < 129) return;
    const float mean = 4 * kPi / set_.directionCount();
    int small = 0;
    for (int i = 0; i < set_.directionCount(); ++i) {
        EXPECT_LT(set_.weight(i), 1.06f * mean);
        EXPECT_GT(set_.weight(i), 0.63f * mean);
        small += set_.weight(i) < 0.89f * mean;
    }
    EXPECT_EQ(small, 2);
}

TEST_P(DirectionSetTest, WeightsIntegrateLowOrderPolynomials) {
    if (set_.lineCount() < 129) return;
    // Even spherical harmonics of degree 2 and 4; odd ones vanish by symmetry.
    double y2[3] = {0, 0, 0}, y4[3] = {0, 0, 0}, xy = 0, odd = 0;
    for (int i = 0; i < set_.directionCount(); ++i) {
        const glm::dvec3 d(set_.direction(i));
        const double w = set_.weight(i);
        for (int k = 0; k < 3; ++k) {
            const double s = d[k] * d[k];
            y2[k] += w * (1.5 * s - 0.5);
            y4[k] += w * (35 * s * s - 30 * s + 3) / 8;
        }
        xy += w * d.x * d.y;
        odd += w * (d.x + d.y * d.y * d.z);
    }
    const double bound = 8.0 / set_.lineCount();
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(y2[k], 0, bound / 10);
        EXPECT_NEAR(y4[k], 0, bound);
    }
    EXPECT_NEAR(xy, 0, 1e-6);
    EXPECT_NEAR(odd, 0, 1e-6);
}

}  // namespace
}  // namespace vlf
