#include "vlf/base/parallel.h"

#include <algorithm>
#include <cstdint>
#include <thread>

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>
#endif

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace vlf {

namespace {

/// Flushes denormals to zero while it lives, on every thread alike: ray kernels are slow without,
/// and results must not depend on which thread computed them.
class FlushDenormals {
  public:
#if defined(__SSE2__)
    FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
    ~FlushDenormals() { _mm_setcsr(saved_); }

  private:
    std::uint32_t saved_;
#endif
};

int nicenessOfThread() {
#if defined(__linux__)
    return getpriority(PRIO_PROCESS, 0);  // 0: the calling thread
#else
    return 0;
#endif
}

void setNicenessOfThread(int niceness) {
#if defined(__linux__)
    setpriority(PRIO_PROCESS, 0, niceness);
#endif
}

}  // namespace

}  // namespace vlf

#if VLF_STD_THREADS

#include <atomic>
#include <exception>
#include <mutex>
#include <vector>

namespace vlf {

namespace {
std::atomic<int> threadLimit{0};
thread_local int backgroundThreads = 0;

int smallerLimit(int a, int b) {
    return a > 0 && b > 0 ? std::min(a, b) : std::max(a, b);
}
}  // namespace

int threadCount() {
    const int limit = smallerLimit(threadLimit.load(), backgroundThreads);
    return limit > 0 ? limit : std::max(1u, std::thread::hardware_concurrency());
}

void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t)>& body) {
    grain = std::max<std::size_t>(grain, 1);
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failureMutex;
    const auto work = [&] {
        const FlushDenormals flush;
        for (std::size_t begin; (begin = next.fetch_add(grain)) < count;) {
            try {
                for (std::size_t i = begin; i < std::min(begin + grain, count); ++i) body(i);
            } catch (...) {
                const std::lock_guard lock(failureMutex);
                if (!failure) failure = std::current_exception();
                next.store(count);
            }
        }
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < threadCount(); ++i) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

void runInBackground(int niceness, int threads, const std::function<void()>& work) {
    setNicenessOfThread(nicenessOfThread() + niceness);  // threads it starts inherit it
    backgroundThreads = threads;
    work();
    backgroundThreads = 0;
}

ThreadLimit::ThreadLimit(int n) {
    threadLimit.store(n);
}
ThreadLimit::~ThreadLimit() {
    threadLimit.store(0);
}

}  // namespace vlf

#else

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>

namespace vlf {

namespace {

/// Gives every thread that comes to work in an arena a niceness.
class Niceness : public tbb::task_scheduler_observer {
  public:
    Niceness(tbb::task_arena& arena, int niceness)
        : task_scheduler_observer(arena), niceness_(niceness) {
        observe(true);
    }
    ~Niceness() override { observe(false); }

    void on_scheduler_entry(bool) override { setNicenessOfThread(niceness_); }

  private:
    int niceness_;
};

}  // namespace

void runInBackground(int niceness, int threads, const std::function<void()>& work) {
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    const Niceness observer(arena, nicenessOfThread() + niceness);
    arena.execute(work);
}

int threadCount() {
    return static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t)>& body) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, std::max<std::size_t>(grain, 1)),
        [&](const tbb::blocked_range<std::size_t>& range) {
            const FlushDenormals flush;
            for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
        },
        tbb::simple_partitioner());
}

ThreadLimit::ThreadLimit(int n) {
    if (n > 0)
        control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                           static_cast<std::size_t>(n));
}

ThreadLimit::~ThreadLimit() {
    delete static_cast<tbb::global_control*>(control_);
}

}  // namespace vlf

#endif
