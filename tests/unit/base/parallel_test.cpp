#include "vlf/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace vlf {
namespace {

TEST(ParallelFor, CallsEveryIndexOnce) {
    for (const std::size_t grain : {0, 1, 7, 1000, 100000}) {
        std::vector<std::atomic<int>> calls(10007);
        parallelFor(calls.size(), grain, [&](std::size_t i) { ++calls[i]; });
        EXPECT_TRUE(std::ranges::all_of(calls, [](const auto& n) { return n == 1; })) << grain;
    }
}

TEST(ParallelFor, DoesNothingForNoIndices) {
    parallelFor(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, RethrowsTheExceptionOfABody) {
    const auto failing = [](std::size_t i) {
        if (i == 421) throw std::runtime_error("body " + std::to_string(i));
    };
    try {
        parallelFor(1000, failing);
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "body 421");
    }
}

TEST(ParallelFor, StopsEarlyAfterAnException) {
    std::atomic<int> calls{0};
    EXPECT_THROW(parallelFor(1'000'000,
                             [&](std::size_t) {
                                 ++calls;
                                 throw std::runtime_error("first");
                             }),
                 std::runtime_error);
    EXPECT_LT(calls, 1'000'000);
}

TEST(ParallelFor, WorksAgainAfterAnException) {
    EXPECT_THROW(parallelFor(10, [](std::size_t) { throw std::logic_error(""); }),
                 std::logic_error);
    std::atomic<int> calls{0};
    parallelFor(10, [&](std::size_t) { ++calls; });
    EXPECT_EQ(calls, 10);
}

TEST(ParallelFor, Nests) {
    std::vector<std::atomic<int>> calls(64 * 64);
    parallelFor(
        64, [&](std::size_t i) { parallelFor(64, [&](std::size_t j) { ++calls[64 * i + j]; }); });
    EXPECT_TRUE(std::ranges::all_of(calls, [](const auto& n) { return n == 1; }));
}

TEST(ParallelFor, RethrowsFromANestedLoop) {
    EXPECT_THROW(parallelFor(8,
                             [](std::size_t) {
                                 parallelFor(8, [](std::size_t j) {
                                     if (j == 3) throw std::out_of_range("inner");
                                 });
                             }),
                 std::out_of_range);
}

bool denormalsAreFlushed() {
    volatile float smallest = std::numeric_limits<float>::min();
    return smallest * 0.5f == 0.0f;
}

TEST(ParallelFor, FlushesDenormalsInsideABodyOnly) {
#if defined(__SSE2__)
    std::atomic<int> flushed{0};
    parallelFor(1000, [&](std::size_t) { flushed += denormalsAreFlushed(); });
    EXPECT_EQ(flushed, 1000);
#endif
    EXPECT_FALSE(denormalsAreFlushed());
}

TEST(ThreadLimit, LimitsTheThreadsAtWork) {
    const int before = threadCount();
    EXPECT_GE(before, 1);
    {
        const ThreadLimit limit(1);
        EXPECT_EQ(threadCount(), 1);
        std::atomic<int> atWork{0}, most{0};
        parallelFor(1000, [&](std::size_t) {
            const int now = ++atWork;
            if (now > most) most = now;
            --atWork;
        });
        EXPECT_EQ(most, 1);
    }
    EXPECT_EQ(threadCount(), before);
}

#if defined(__linux__)
TEST(RunInBackground, LowersThePriorityOfAllThatWork) {
    std::thread([] {  // which keeps the low priority
        const int before = getpriority(PRIO_PROCESS, 0);
        std::atomic<int> calls{0}, lowered{0};
        runInBackground(5, 0, [&] {
            parallelFor(1000, [&](std::size_t) {
                ++calls;
                lowered += getpriority(PRIO_PROCESS, 0) == std::min(19, before + 5);
            });
        });
        EXPECT_EQ(calls, 1000);
        EXPECT_EQ(lowered, 1000);
    })
        .join();
}
#endif

TEST(RunInBackground, LimitsTheThreadsAtWork) {
    std::atomic<int> atWork{0}, most{0};
    runInBackground(0, 1, [&] {
        parallelFor(1000, [&](std::size_t) {
            const int now = ++atWork;
            if (now > most) most = now;
            --atWork;
        });
    });
    EXPECT_EQ(most, 1);
}

TEST(RunInBackground, HandsExceptionsOn) {
    EXPECT_THROW(runInBackground(0, 0, [] { throw std::runtime_error("work"); }),
                 std::runtime_error);
}

TEST(ThreadLimit, OfZeroIsNoLimit) {
    const int before = threadCount();
    const ThreadLimit limit(0);
    EXPECT_EQ(threadCount(), before);
}

}  // namespace
}  // namespace vlf
