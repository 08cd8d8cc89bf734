#pragma once
// The one parallel loop of the program: oneTBB, or plain std::thread where ThreadSanitizer must
// see every synchronisation (VLF_STD_THREADS).

#include <cstddef>
#include <functional>

namespace vlf {

/// Calls body(i) once for every i in [0, count), on several threads, `grain` consecutive indices
/// at a time. Returns when all are done. The first exception thrown by a body is rethrown here
/// after the others have stopped. Order and thread of the calls are unspecified: results must not
/// depend on them. Denormal numbers are flushed to zero inside a body.
void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t)>& body);

/// The same without the memory that a std::function takes to hold a body.
template <class Body>
void parallelFor(std::size_t count, std::size_t grain, const Body& body) {
    parallelFor(count, grain, std::function<void(std::size_t)>(std::cref(body)));
}

/// parallelFor with a grain of 1, for bodies that are long.
template <class Body>
void parallelFor(std::size_t count, const Body& body) {
    parallelFor(count, 1, body);
}

/// Number of threads that parallelFor uses.
int threadCount();

/// Calls work() on this thread, so that it leaves the processor to the rest of the program: this
/// thread and those that help it in parallelFor run at a priority lowered by `niceness` (0: not at
/// all; 19: only what nobody else wants), and are at most `threads` (0: one per core).
/// Priorities of single threads exist on Linux, elsewhere niceness is ignored. They stay lowered:
/// an unprivileged thread cannot raise its own.
void runInBackground(int niceness, int threads, const std::function<void()>& work);

/// Limits every parallelFor in the process to n threads (n >= 1; 0: one per core) while it lives.
class ThreadLimit {
  public:
    explicit ThreadLimit(int n);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    void* control_ = nullptr;
};

}  // namespace vlf
