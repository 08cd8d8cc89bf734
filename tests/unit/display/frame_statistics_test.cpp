#include "vlf/display/frame_statistics.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

TEST(FrameStatistics, SaysRateMedianAndTheSlowest) {
    FrameStatistics statistics(10);
    EXPECT_EQ(statistics.rate(), 0);
    EXPECT_EQ(statistics.times().median, 0);
    for (int i = 0; i < 99; ++i) statistics.add(0.010);
    statistics.add(0.110);
    EXPECT_NEAR(statistics.rate(), 100 / 1.1, 1e-6);
    EXPECT_EQ(statistics.times().median, 0.010);
    EXPECT_EQ(statistics.times().max, 0.110);
    EXPECT_EQ(statistics.milliseconds().size(), 100u);
    EXPECT_FLOAT_EQ(statistics.milliseconds().back(), 110);
}

TEST(FrameStatistics, ForgetsWhatIsLongAgo) {
    FrameStatistics statistics(1);
    statistics.add(0.5);
    for (int i = 0; i < 200; ++i) statistics.add(0.010);
    EXPECT_EQ(statistics.times().max, 0.010);
    EXPECT_LE(statistics.milliseconds().size(), 101u);
}

TEST(FrameStatistics, KeepsTheLastFrameHoweverLongItWas) {
    FrameStatistics statistics(1);
    statistics.add(7);
    EXPECT_EQ(statistics.times().median, 7);
}

}  // namespace
}  // namespace vlf
