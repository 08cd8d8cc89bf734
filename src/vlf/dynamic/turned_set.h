#pragma once
// How direction sets lie in an object.

#include "vlf/math/vector.h"

namespace vlf {

/// Of sampleUniformRotation: aslant, since a set as it is has directions within the planes of the
/// axes, which are those of many objects' sides.
inline const Vec3 kTurn{0.37f, 0.11f, 0.63f};

}  // namespace vlf
