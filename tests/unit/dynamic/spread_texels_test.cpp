#include "vlf/dynamic/spread_texels.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu, kWidth = 16;

/// A chart of 6 x 4 texels in an atlas of 16 x 12.
Chart chart() {
    Chart c;
    c.x = 5;
    c.y = 4;
    c.width = 6;
    c.height = 4;
    return c;
}

std::uint32_t at(std::uint32_t x, std::uint32_t y) {
    return y * kWidth + x;
}

bool isOfChart(std::uint32_t x, std::uint32_t y) {
    const Chart c = chart();
    return x + kGutter >= c.x && x < c.x + c.width + kGutter && y + kGutter >= c.y &&
           y < c.y + c.height + kGutter;
}

TEST(SpreadTexels, FillsTheChartAndItsGutterAndNothingElse) {
    std::vector<std::uint32_t> map(kWidth * 12, kNone);
    map[at(7, 5)] = 42;
    map[at(0, 0)] = 7;  // another chart's
    spreadOverChart(chart(), kWidth, kNone, map);
    for (std::uint32_t y = 0; y < 12; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x)
            EXPECT_EQ(map[at(x, y)], isOfChart(x, y) ? 42 : x + y == 0 ? 7 : kNone) << x << " " << y;
}

TEST(SpreadTexels, TakesTheNearest) {
    std::vector<std::uint32_t> map(kWidth * 12, kNone);
    map[at(5, 4)] = 1;
    map[at(10, 7)] = 2;
    spreadOverChart(chart(), kWidth, kNone, map);
    for (std::uint32_t y = 4; y < 8; ++y)
        for (std::uint32_t x = 5; x < 11; ++x) {
            const std::uint32_t first = x - 5 + y - 4, second = 10 - x + 7 - y;
            if (first != second) {
                EXPECT_EQ(map[at(x, y)], first < second ? 1u : 2u) << x << " " << y;
            }
        }
}

TEST(SpreadTexels, LeavesAnEmptyChartEmpty) {
    std::vector<std::uint32_t> map(kWidth * 12, kNone);
    spreadOverChart(chart(), kWidth, kNone, map);
    EXPECT_EQ(map, std::vector<std::uint32_t>(kWidth * 12, kNone));
}

}  // namespace
}  // namespace vlf
