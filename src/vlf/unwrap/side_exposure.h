#pragma once
// Which sides of the surfaces light can reach. The inside of a solid needs no texels, and a hit on
// it tells a texel that it lies under other geometry.

#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/chart_groups.h"

#include <vector>

namespace vlf {

struct OpenSides {
    bool front = true, back = false;
};

/// Classifies both sides of every group by a flood of particles that start at the emitters, at
/// punctual lights, and outside where there is an environment, and bounce about without loss. The
/// front of a group counts as open unless only its back is reached; both sides of glass do.
/// `groupOf` gives the group of each triangle. Deterministic for a seed.
std::vector<OpenSides> findOpenSides(const Scene& scene, const RayScene& rays,
                                     const std::vector<ChartGroup>& groups,
                                     const std::vector<std::uint32_t>& groupOf, std::uint64_t seed);

}  // namespace vlf
