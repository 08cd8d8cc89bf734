#pragma once
// How long frames take: what most do, and the slow ones.

#include <vector>

namespace vlf {

/// Of some times, in their unit; percentiles are interpolated linearly between order statistics, as
/// numpy and R do by default.
struct TimeStatistics {
    double median = 0, p95 = 0, p99 = 0, max = 0;

    /// How much longer than most the slow frames are; 0 if the median is.
    double p99OverMedian() const { return median > 0 ? p99 / median : 0; }
};

/// All 0 if there are no times.
TimeStatistics statisticsOf(std::vector<double> times);

}  // namespace vlf
