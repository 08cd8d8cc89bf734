#pragma once
// The sides of triangles by what is drawn in one call.

#include "vlf/field/chart.h"
#include "vlf/render/gl/room_geometry.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

struct Side {
    std::uint32_t triangle;
    std::uint32_t chart;  ///< kNoChart: it is black
    bool front;
    bool cull;  ///< the other side is drawn, too
};

/// Sides of one material that share all state, each set a batch; those of mirrors last. A triangle
/// without charts has a front side.
std::vector<std::vector<Side>> sortSides(const Scene& scene,
                                         std::span<const TriangleCharts> charts);

/// All of a batch but its indices, which begin at `firstIndex`.
RoomBatch batchOf(const Scene& scene, const Side& side, std::size_t firstIndex);

}  // namespace vlf
