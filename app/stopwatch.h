#pragma once
// Time that work has taken.

#include <chrono>

namespace vlf::app {

/// Runs from when it is made.
class Stopwatch {
  public:
    double milliseconds() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    }
    double seconds() const { return 1e-3 * milliseconds(); }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace vlf::app
