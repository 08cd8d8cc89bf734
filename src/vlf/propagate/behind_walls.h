#pragma once
// Where a wall or a panel stands on a surface that goes on behind it into a place no light reaches:
// inside a closed cabinet, behind a mirror that hangs in a frame. Texels before the wall are
// interpolated with the dark ones behind it, and a dark line would be seen along its foot.

#include "vlf/field/irradiance_atlas.h"
#include "vlf/propagate/bake.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Gives the texels that such walls divide, and the dark ones next to the wall, the light before
/// it. Nobody who is where light is sees them but interpolated; in the dark place itself light
/// shows for up to two texels from the wall. `known` are the atlas texels that have a value.
void continueBehindWalls(const BakeState& state, IrradianceAtlas& atlas,
                         std::vector<std::uint8_t>& known);

}  // namespace vlf
