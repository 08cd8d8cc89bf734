#pragma once
// Gives a group of triangles its texel grid: the smallest rectangle around its projection, divided
// evenly.

#include "vlf/field/chart.h"
#include "vlf/scene/scene.h"
#include "vlf/unwrap/chart_groups.h"

namespace vlf {

/// The chart of the group's front; its atlas position is still to be set. Texels are at most
/// `texelSize` metres wide.
Chart layOutChart(const Scene& scene, const ChartGroup& group, float texelSize);

/// The chart of the other side: the same texels, facing the other way.
Chart backOf(const Chart& chart);

}  // namespace vlf
