#pragma once
// From the texels' irradiance to an atlas that can be sampled anywhere: seams agree, gutters
// continue their chart.

#include "vlf/field/irradiance_atlas.h"
#include "vlf/propagate/bake.h"

namespace vlf {

IrradianceAtlas fillAtlas(const BakeState& state);

}  // namespace vlf
