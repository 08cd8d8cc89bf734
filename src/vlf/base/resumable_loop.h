#pragma once
// Parallel loops that can be left and taken up again.

#include "vlf/base/progress.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace vlf {

/// Which indices of a loop are done (1); empty: it has not begun.
using LoopMarks = std::vector<std::uint8_t>;

/// A parallelFor that can be left: calls body(i) for every i in [0, count) that is not marked as
/// done, marks it and counts a step. Returns whether all are done; if not, a pause is due. After
/// that, as after Cancelled, the same call with the same marks goes on.
bool resumeLoop(LoopMarks& done, std::size_t count, std::size_t grain, ProgressCounter& counter,
                const std::function<void(std::size_t)>& body);

/// How many are marked.
std::size_t countDone(const LoopMarks& done);

}  // namespace vlf
