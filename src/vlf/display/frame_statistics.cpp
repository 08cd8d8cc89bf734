#include "vlf/display/frame_statistics.h"

#include <algorithm>
#include <cmath>

namespace vlf {

void FrameStatistics::add(double seconds) {
    frames_.push_back(seconds);
    sum_ += seconds;
    while (frames_.size() > 1 && sum_ > window_) {
        sum_ -= frames_.front();
        frames_.pop_front();
    }
}

double FrameStatistics::rate() const {
    return sum_ > 0 ? static_cast<double>(frames_.size()) / sum_ : 0;
}

double FrameStatistics::percentile(double part) const {
    if (frames_.empty()) return 0;
    std::vector<double> sorted(frames_.begin(), frames_.end());
    const auto at =
        static_cast<std::size_t>(std::lround(part * static_cast<double>(sorted.size() - 1)));
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(at),
                     sorted.end());
    return sorted[at];
}

std::vector<float> FrameStatistics::milliseconds() const {
    std::vector<float> all;
    for (const double seconds : frames_) all.push_back(static_cast<float>(1e3 * seconds));
    return all;
}

}  // namespace vlf
