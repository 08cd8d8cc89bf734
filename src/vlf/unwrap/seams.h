#pragma once
// Seams: where the surface goes on beyond the edge of a chart, so that neighbouring charts can be
// made to agree.

#include "vlf/unwrap/unwrap.h"

namespace vlf {

/// For every uncovered texel next to a covered one (gutter included), looks for the surface that
/// continues the chart there: a different chart, of nearly the same plane and facing.
std::vector<SeamLink> findSeams(const Scene& scene, const RayScene& rays, const Unwrap& unwrap);

}  // namespace vlf
