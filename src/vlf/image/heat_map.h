#pragma once
// False colours for per-pixel errors.

#include "vlf/image/image.h"

#include <span>

namespace vlf {

/// Linear colour of t in [0, 1] (clamped; NaN as 1): black, purple, orange, pale yellow, with
/// luminance rising throughout. A fit to the "magma" map of matplotlib.
Vec3 heatColor(float t);

/// One value per pixel, row-major, coloured on a scale from 0 to `white`; ready for writePng.
/// Throws std::logic_error unless there are width * height values.
Image heatMap(std::span<const float> values, int width, int height, float white = 1);

}  // namespace vlf
