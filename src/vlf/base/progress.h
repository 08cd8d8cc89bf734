#pragma once
// Progress and cancellation of long work, one object handed down by the caller.

#include <atomic>
#include <cstddef>
#include <mutex>
#include <string>

namespace vlf {

/// Told how far a long computation is, and asked whether to go on. Methods are called from one
/// thread at a time, unless they say otherwise; cancel() may be called from any thread or signal
/// handler.
class Progress {
  public:
    virtual ~Progress() = default;

    /// A new stage begins, e.g. "direct light".
    virtual void stage(const std::string& name) { (void)name; }

    /// `fraction` in [0, 1] of the current stage is done.
    virtual void update(double fraction) { (void)fraction; }

    /// Whether long work should pause as soon as it can, between its parallel loops, so that it can
    /// be shown or kept. Called from several threads at once, and often.
    virtual bool pauseDue() const { return false; }

    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

    /// Throws Cancelled if cancel() was called.
    void check() const;

  private:
    std::atomic<bool> cancelled_{false};
};

/// Counts the finished parts of a parallel stage and tells its Progress.
class ProgressCounter {
  public:
    /// `done` of the `total` parts were done before.
    ProgressCounter(Progress& progress, std::size_t total, std::size_t done = 0)
        : progress_(progress), total_(total), done_(done) {}

    /// One more part is done. Callable from several threads; throws Cancelled.
    void step();

    bool pauseDue() const { return progress_.pauseDue(); }

  private:
    Progress& progress_;
    std::size_t total_;
    std::atomic<std::size_t> done_;
    std::mutex mutex_;
};

}  // namespace vlf
