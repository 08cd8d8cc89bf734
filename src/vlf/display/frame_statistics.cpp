#include "vlf/display/frame_statistics.h"

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

TimeStatistics FrameStatistics::times() const {
    return statisticsOf({frames_.begin(), frames_.end()});
}

std::vector<float> FrameStatistics::milliseconds() const {
    std::vector<float> all;
    for (const double seconds : frames_) all.push_back(static_cast<float>(1e3 * seconds));
    return all;
}

}  // namespace vlf
