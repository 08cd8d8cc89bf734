#include "vlf/base/resumable_loop.h"

#include "vlf/base/parallel.h"

#include <algorithm>

namespace vlf {

bool resumeLoop(LoopMarks& done, std::size_t count, std::size_t grain, ProgressCounter& counter,
                const std::function<void(std::size_t)>& body) {
    done.resize(count, 0);
    parallelFor(count, grain, [&](std::size_t i) {
        if (done[i] || counter.pauseDue()) return;
        body(i);
        done[i] = 1;
        counter.step();
    });
    return countDone(done) == count;
}

std::size_t countDone(const LoopMarks& done) {
    return static_cast<std::size_t>(std::count(done.begin(), done.end(), 1));
}

}  // namespace vlf
