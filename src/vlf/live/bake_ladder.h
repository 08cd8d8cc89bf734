#pragma once
// The bakes on the way to the one that is wanted.

#include "vlf/propagate/bake.h"

#include <vector>

namespace vlf {

/// Parameters of bakes that take several times as long from one to the next: "preview", then the
/// presets below wanted.preset, and `wanted` itself. Seed and number of bounces are those of
/// `wanted`, and none has mirrors' radiance if that has not.
std::vector<BakeParams> bakeLadder(const BakeParams& wanted);

}  // namespace vlf
