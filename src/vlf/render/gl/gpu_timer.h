#pragma once
// How long the GPU works at a part of each frame.

#include "vlf/render/gl/gl_object.h"

#include <array>
#include <cstddef>
#include <optional>

namespace vlf::gl {

/// Measures without waiting: a result comes some frames later. Of several timers one may run at a
/// time (GL_TIME_ELAPSED).
class GpuTimer {
  public:
    GpuTimer();

    /// Not measured if the results of the last kQueries frames are still to come.
    void begin();
    void end();

    /// Of the last frame whose result has come; none before the first.
    std::optional<double> milliseconds();

  private:
    static constexpr std::size_t kQueries = 4;

    void collect();

    std::array<Query, kQueries> queries_;
    std::size_t begun_ = 0, collected_ = 0;  ///< how many ever; the queries between are under way
    bool running_ = false;
    std::optional<double> milliseconds_;
};

/// Runs a timer while it lives.
class TimedPass {
  public:
    explicit TimedPass(GpuTimer& timer) : timer_(timer) { timer_.begin(); }
    ~TimedPass() { timer_.end(); }
    TimedPass(const TimedPass&) = delete;
    TimedPass& operator=(const TimedPass&) = delete;

  private:
    GpuTimer& timer_;
};

}  // namespace vlf::gl
