#pragma once
// Pearson's chi-square test of observed against expected counts.

#include <cmath>
#include <cstddef>
#include <span>

namespace vlf::test {

/// How many standard deviations the chi-square statistic of `observed` lies above what is expected
/// by chance (Wilson and Hilferty 1931). Below 4 in all but one of 30 000 correct samplers.
/// Both spans have the same size and the same sum; every expected count should be above 5.
inline double chiSquareDeviation(std::span<const double> observed,
                                 std::span<const double> expected) {
    double statistic = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        const double d = observed[i] - expected[i];
        statistic += d * d / expected[i];
    }
    const double freedom = static_cast<double>(observed.size()) - 1;
    const double spread = 2 / (9 * freedom);
    return (std::cbrt(statistic / freedom) - (1 - spread)) / std::sqrt(spread);
}

}  // namespace vlf::test
