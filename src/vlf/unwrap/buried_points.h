#pragma once
// Points that lie under other geometry: a floor beneath a cabinet that stands on it.

#include "vlf/unwrap/unwrap.h"

namespace vlf {

/// Removes the points from whose side one sees closed sides of surfaces, straight above and in most
/// directions, and the texels that have no point left, into unwrap.buried. Texels that a thin wall
/// divides go too, into unwrap.divided: they would carry light from one side to the other.
/// Throws Cancelled.
void dropBuriedPoints(const Scene& scene, const RayScene& rays, Unwrap& unwrap,
                      const Progress& progress);

}  // namespace vlf
