#pragma once
// How long the last frames took.

#include "vlf/display/time_statistics.h"

#include <deque>
#include <vector>

namespace vlf {

/// Remembers the frames of the last `window` seconds.
class FrameStatistics {
  public:
    explicit FrameStatistics(double window = 5) : window_(window) {}

    void add(double seconds);

    bool empty() const { return frames_.empty(); }
    double rate() const;                      ///< frames a second; 0: none yet
    TimeStatistics times() const;             ///< of the frames, s
    std::vector<float> milliseconds() const;  ///< of each frame, oldest first

  private:
    double window_;
    double sum_ = 0;
    std::deque<double> frames_;
};

}  // namespace vlf
