#include "vlf/math/random.h"

#include "support/chi_square.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr int kBins = 32;

/// Bins pairs of numbers in [0, 1) and tests that all cells of the square fill alike.
class PairHistogram {
  public:
    void add(float x, float y) {
        ASSERT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1) << x << ' ' << y;
        ++count_[static_cast<int>(x * kBins) * kBins + static_cast<int>(y * kBins)];
        ++total_;
    }
    double deviation() const {
        const std::vector<double> expected(count_.size(), total_ / count_.size());
        return test::chiSquareDeviation(count_, expected);
    }

  private:
    std::vector<double> count_ = std::vector<double>(kBins * kBins, 0.0);
    double total_ = 0;
};

TEST(RandomStream, PairsOfSuccessiveNumbersFillTheSquare) {
    PairHistogram histogram;
    RandomStream random(7, 42);
    for (int i = 0; i < 200000; ++i) {
        const Vec2 u = random.next2();
        histogram.add(u.x, u.y);
    }
    EXPECT_LT(histogram.deviation(), 4);
    EXPECT_GT(histogram.deviation(), -4) << "too even to be random";
}

TEST(RandomStream, StreamsOfNeighbouringKeysAreIndependent) {
    for (int skip = 0; skip < 3; ++skip) {
        PairHistogram histogram;
        for (std::uint64_t key = 0; key < 100000; ++key) {
            RandomStream a(1, key), b(1, key + 1);
            for (int i = 0; i < skip; ++i) a.next(), b.next();
            histogram.add(a.next(), b.next());
        }
        EXPECT_LT(histogram.deviation(), 4) << skip;
    }
}

TEST(RandomStream, StreamsOfNeighbouringSeedsAreIndependent) {
    PairHistogram histogram;
    for (std::uint64_t seed = 0; seed < 100000; ++seed)
        histogram.add(RandomStream(seed, 5).next(), RandomStream(seed + 1, 5).next());
    EXPECT_LT(histogram.deviation(), 4);
}

TEST(RandomStream, IsAFunctionOfSeedAndKey) {
    RandomStream a(3, 9), b(3, 9), otherKey(3, 10), otherSeed(4, 9);
    const std::uint64_t bits = a.nextBits();
    EXPECT_EQ(bits, b.nextBits());
    EXPECT_NE(bits, otherKey.nextBits());
    EXPECT_NE(bits, otherSeed.nextBits());
}

TEST(RandomStream, StaysBelowOneForAllBitsSet) {
    EXPECT_LT(toUnitFloat(~0ull), 1.0f);
    EXPECT_EQ(toUnitFloat(0), 0.0f);
}

TEST(R2Point, SpreadsEvenlyFromAnyShift) {
    for (const Vec2 shift : {Vec2(0), Vec2(0.37f, 0.91f)}) {
        std::vector<int> count(64, 0);
        for (std::uint32_t i = 0; i < 6400; ++i) {
            const Vec2 p = r2Point(i, shift);
            ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
            ++count[static_cast<int>(p.x * 8) * 8 + static_cast<int>(p.y * 8)];
        }
        // Random points would spread over 100 +- 30.
        EXPECT_GE(*std::ranges::min_element(count), 94);
        EXPECT_LE(*std::ranges::max_element(count), 106);
    }
}

TEST(R2Point, StaysInTheSquareForAnyIndex) {
    for (const std::uint32_t i : {0u, 1u, 1u << 24, 0xffffffffu}) {
        const Vec2 p = r2Point(i, {0.99999994f, 0.99999994f});
        EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << i;
    }
}

}  // namespace
}  // namespace vlf
