#pragma once
// Numbers that belong to texels, seen on the surfaces of the room.

#include "vlf/base/progress.h"
#include "vlf/field/light_field.h"
#include "vlf/image/image.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <span>

namespace vlf {

/// One value per texel of the field's atlas (row-major), as a camera sees them: colours of
/// heatColor from `least` (black) to `most` (pale yellow) on a logarithmic scale, where the charts
/// end a thin grey line. What lies outside the room or has no texel is grey. Mirrors are not
/// followed: the values are those of their own texels. Ready for writePng. Throws Cancelled,
/// InputError if the camera has no view, std::logic_error unless there is one value per texel and
/// 0 < least < most.
Image drawTexelValues(const Scene& scene, const RayScene& rays, const LightField& field,
                      std::span<const float> values, float least, float most, const Camera& camera,
                      int width, int height, Progress& progress);

}  // namespace vlf
