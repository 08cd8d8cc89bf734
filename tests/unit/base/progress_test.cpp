#include "vlf/base/progress.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include <gtest/gtest.h>

namespace vlf {
namespace {

struct RecordingProgress : Progress {
    std::vector<double> fractions;
    std::atomic<int> inside{0};
    bool overlapped = false;

    void update(double fraction) override {
        overlapped |= inside.fetch_add(1) != 0;
        fractions.push_back(fraction);
        inside.fetch_sub(1);
    }
};

TEST(Progress, CheckThrowsOnlyOnceCancelled) {
    Progress progress;
    EXPECT_NO_THROW(progress.check());
    progress.cancel();
    EXPECT_TRUE(progress.cancelled());
    EXPECT_THROW(progress.check(), Cancelled);
}

TEST(ProgressCounter, CountsToOneAndUpdatesFromOneThreadAtATime) {
    RecordingProgress progress;
    ProgressCounter counter(progress, 1000);
    parallelFor(1000, [&](std::size_t) { counter.step(); });
    EXPECT_FALSE(progress.overlapped);
    ASSERT_FALSE(progress.fractions.empty());
    EXPECT_DOUBLE_EQ(*std::max_element(progress.fractions.begin(), progress.fractions.end()), 1.0);
}

TEST(ProgressCounter, StopsAParallelLoopThatIsCancelled) {
    Progress progress;
    ProgressCounter counter(progress, 100000);
    std::atomic<int> done{0};
    EXPECT_THROW(parallelFor(100000,
                             [&](std::size_t) {
                                 counter.step();
                                 if (++done == 100) progress.cancel();
                             }),
                 Cancelled);
    EXPECT_LT(done, 100000);
}

}  // namespace
}  // namespace vlf
