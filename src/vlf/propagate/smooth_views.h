#pragma once
// Noise of what the cells of a rough mirror show, taken away by what their neighbours show.

#include "vlf/propagate/mirror_view.h"

#include <span>
#include <vector>

namespace vlf {

/// Means over neighbouring cells of one chart: as far about each as a part of its lobe is wide at
/// the distance of what it sees, where all see nearly the same, and where the mirror faces alike.
/// `points`: by cell, with shading normals; `roughness`: width of the lobe; `cellSize`: metres.
void smoothViews(std::vector<MirrorView>& views, std::span<const MirrorCell> cells,
                 std::span<const ViewPoint> points, float roughness, float cellSize);

}  // namespace vlf
