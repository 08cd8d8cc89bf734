#pragma once
// Progress and cancellation of long work, one object handed down by the caller.

#include <atomic>
#include <string>

namespace vlf {

/// Told how far a long computation is, and asked whether to go on. Methods are called from one
/// thread at a time; cancel() may be called from any thread or signal handler.
class Progress {
  public:
    virtual ~Progress() = default;

    /// A new stage begins, e.g. "direct light".
    virtual void stage(const std::string& name) { (void)name; }

    /// `fraction` in [0, 1] of the current stage is done.
    virtual void update(double fraction) { (void)fraction; }

    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

    /// Throws Cancelled if cancel() was called.
    void check() const;

  private:
    std::atomic<bool> cancelled_{false};
};

}  // namespace vlf
