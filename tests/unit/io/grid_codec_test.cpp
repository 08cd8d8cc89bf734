#include "vlf/io/grid_codec.h"

#include "vlf/math/random.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

template <class Codec>
std::vector<typename Codec::Element> randomGrid(std::size_t count, int bits) {
    RandomStream random(1, count);
    std::vector<typename Codec::Element> grid(count);
    for (auto& element : grid)
        for (auto& value : element)
            value = static_cast<std::decay_t<decltype(value)>>(random.nextBits() >> (64 - bits));
    return grid;
}

template <class Codec>
void expectRoundTrip(int bits) {
    for (const std::size_t width : {1, 2, 7, 64})
        for (const std::size_t height : {0, 1, 2, 9}) {
            const auto grid = randomGrid<Codec>(width * height, bits);
            const auto planes = Codec::encode(grid, width);
            ASSERT_EQ(planes.size(), grid.size() * Codec::kElementBytes);
            auto decoded = grid;
            for (auto& element : decoded) element = {};
            Codec::decode(planes, decoded, width);
            ASSERT_EQ(decoded, grid) << width << " x " << height;
        }
}

TEST(GridCodec, AnyGridSurvivesEncoding) {
    expectRoundTrip<GridCodec<std::uint8_t, 4>>(8);
    expectRoundTrip<GridCodec<std::uint32_t, 3>>(32);
    expectRoundTrip<GridCodec<std::uint32_t, 17>>(32);
}

TEST(GridCodec, NarrowResidualsSufficeForValuesOfOneBitLess) {
    expectRoundTrip<GridCodec<std::uint32_t, 3, 3>>(23);
}

TEST(GridCodec, ZigzagOrdersDifferencesBySize) {
    EXPECT_EQ(zigzag<std::uint16_t>(0), 0);
    EXPECT_EQ(zigzag<std::uint16_t>(0xffff), 1);
    EXPECT_EQ(zigzag<std::uint16_t>(1), 2);
    EXPECT_EQ(zigzag<std::uint16_t>(0x8000), 0xffff);
    for (int i = 0; i < 256; ++i) {
        const auto value = static_cast<std::uint8_t>(i);
        EXPECT_EQ(unzigzag(zigzag(value)), value);
    }
}

TEST(GridCodec, MedianPredictsAtEdgesFromTheirOneSide) {
    EXPECT_EQ((predictMedian<std::uint16_t>(10, 50, 10)), 50);
    EXPECT_EQ((predictMedian<std::uint16_t>(50, 10, 10)), 50);
    EXPECT_EQ((predictMedian<std::uint16_t>(20, 40, 30)), 30);
    EXPECT_EQ((predictMedian<std::uint32_t>(0xffffffff, 0xfffffff0, 0xfffffff8)), 0xfffffff7);
}

TEST(GridCodec, ASmoothGridIsMostlyZeroBytes) {
    using Codec = GridCodec<std::uint32_t, 1>;
    std::vector<Codec::Element> grid;
    for (std::uint32_t i = 0; i < 64 * 64; ++i) grid.push_back({1000000 + 3 * (i % 64) - i / 64});
    const auto planes = Codec::encode(grid, 64);
    const auto zeros = std::count(planes.begin(), planes.end(), 0);
    EXPECT_GT(zeros, 0.98 * static_cast<double>(planes.size()));
}

}  // namespace
}  // namespace vlf
