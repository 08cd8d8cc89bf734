#pragma once
// Names of the pictures of a sequence: a pattern such as room-%05d.png.

#include <string>

namespace vlf::app {

/// Empty if the name holds one %d or %0Nd (N from 1 to 9) and no other %, else what is wrong.
std::string framePatternProblem(const std::string& pattern);

/// The name of a frame. Precondition: the pattern has no problem.
std::string frameName(const std::string& pattern, int frame);

}  // namespace vlf::app
