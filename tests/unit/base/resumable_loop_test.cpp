#include "vlf/base/resumable_loop.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <atomic>

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr std::size_t kCount = 1000;

struct PausingProgress : Progress {
    std::atomic<bool> due{false};
    double fraction = 0;

    bool pauseDue() const override { return due; }
    void update(double f) override { fraction = f; }
};

class ResumableLoop : public testing::Test {
  protected:
    /// Goes on; a pause is due after `steps` calls of the body, or the work is cancelled.
    bool run(int steps, bool cancel = false) {
        progress.due = false;
        ProgressCounter counter(progress, kCount, countDone(done));
        std::atomic<int> left{steps};
        return resumeLoop(done, kCount, 4, counter, [&](std::size_t i) {
            ++calls[i];
            if (--left > 0) return;
            progress.due = !cancel;
            if (cancel) progress.cancel();
        });
    }
    void expectEachCalledOnce() const {
        EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const auto& n) { return n == 1; }));
    }

    PausingProgress progress;
    LoopMarks done;
    std::vector<std::atomic<int>> calls = std::vector<std::atomic<int>>(kCount);
};

TEST_F(ResumableLoop, RunsWholeWhenNoPauseIsDue) {
    EXPECT_TRUE(run(1 << 20));
    expectEachCalledOnce();
    EXPECT_EQ(progress.fraction, 1);
}

TEST_F(ResumableLoop, GoesOnAfterPausesWithWhatIsLeft) {
    int pauses = 0;
    while (!run(100)) {
        EXPECT_LT(countDone(done), kCount);
        EXPECT_GE(countDone(done), 100u * ++pauses);
    }
    EXPECT_GT(pauses, 2);
    expectEachCalledOnce();
}

TEST_F(ResumableLoop, GoesOnAfterItWasCancelled) {
    EXPECT_THROW(run(100, true), Cancelled);
    EXPECT_GE(countDone(done), 100u);
    EXPECT_LT(countDone(done), kCount);
    PausingProgress another;
    ProgressCounter counter(another, kCount, countDone(done));
    EXPECT_TRUE(resumeLoop(done, kCount, 4, counter, [&](std::size_t i) { ++calls[i]; }));
    expectEachCalledOnce();
}

}  // namespace
}  // namespace vlf
