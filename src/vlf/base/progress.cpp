#include "vlf/base/progress.h"

#include "vlf/base/error.h"

namespace vlf {

void Progress::check() const {
    if (cancelled()) throw Cancelled();
}

void ProgressCounter::step() {
    progress_.check();
    const std::size_t done = done_.fetch_add(1, std::memory_order_relaxed) + 1;
    // Whoever finds the lock taken leaves the telling to another, but for the last.
    std::unique_lock lock(mutex_, std::defer_lock);
    if (done == total_) lock.lock();
    if (lock.owns_lock() || lock.try_lock())
        progress_.update(static_cast<double>(done) / static_cast<double>(total_));
}

}  // namespace vlf
