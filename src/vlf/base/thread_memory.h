#pragma once
// Working memory that is kept from call to call, so that what runs every frame allocates only the
// first time.

#include <utility>

namespace vlf {

/// Lends an object its thread's memory while this lives: `mine`, whose own content does not matter
/// before or after, is exchanged for what the thread kept when it was last lent a T. Not to be
/// nested for one T on one thread; a T of its own for each use.
template <class T>
class ThreadMemory {
  public:
    explicit ThreadMemory(T& mine) : mine_(mine) { std::swap(mine_, kept()); }
    ~ThreadMemory() { std::swap(mine_, kept()); }
    ThreadMemory(const ThreadMemory&) = delete;
    ThreadMemory& operator=(const ThreadMemory&) = delete;

  private:
    static T& kept() {
        thread_local T memory;
        return memory;
    }

    T& mine_;
};

}  // namespace vlf
