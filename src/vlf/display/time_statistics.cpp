#include "vlf/display/time_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vlf {

namespace {

/// Quantile q of sorted times.
double quantile(const std::vector<double>& sorted, double q) {
    const double place = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

}  // namespace

TimeStatistics statisticsOf(std::vector<double> times) {
    if (times.empty()) return {};
    std::sort(times.begin(), times.end());
    return {quantile(times, 0.5), quantile(times, 0.95), quantile(times, 0.99), times.back()};
}

}  // namespace vlf
