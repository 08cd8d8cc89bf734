#pragma once
// Counts what operator new is asked for. For programs of one source file: it replaces the
// operators, but for those of a sanitizer, which it must not mix with its own.

#include <atomic>
#include <cstdlib>
#include <new>

namespace vlf::test {

/// Whether this program's threads, or the one thread, are being counted.
inline std::atomic<bool> countsAllocations{false};
inline thread_local bool countsOwnAllocations = false;
inline std::atomic<int> allocations{0};

}  // namespace vlf::test

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Not inlined, or the compiler sees what new and delete are made of and calls them mismatched.
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (vlf::test::countsAllocations || vlf::test::countsOwnAllocations) ++vlf::test::allocations;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
    std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}
#endif
