#pragma once
// Pictures that explain a light field's own structure.

#include "vlf/base/progress.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/field/light_field.h"
#include "vlf/image/image.h"
#include "vlf/render/drawing/diagram_params.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>

namespace vlf {

/// A diagram in display-linear colours. `directions` and `chart` lie over a dimmed picture from the
/// camera; `subfield` and `tile` look at the whole bounding sphere along the camera's line of
/// sight, without `objects`. Up to antialias² rays per pixel. Throws Cancelled, and InputError if a
/// direction, tile or chart is not in the field or the camera has no view.
Image drawDiagram(const Scene& scene, const RayScene& rays, const LightField& field,
                  const Camera& camera, int width, int height, int antialias,
                  const DiagramParams& params, Progress& progress, std::uint64_t& traced,
                  const DynamicRoom* objects = nullptr);

/// The chart of diagram `chart`: the given one, or that in the middle of the camera's picture.
/// Throws InputError if it is not in the field, or nothing is there.
std::uint32_t chooseChart(const Scene& scene, const RayScene& rays, const LightField& field,
                          const DiagramParams& params, const Camera& camera);

/// Luminance of the brightest texel of a chart.
float brightestTexel(const IrradianceAtlas& atlas, const Chart& chart);

/// The rim of a texel in diagram `chart`: its width, of the texel's side, and its colour, which is
/// this much of the texel's, and a little more.
inline constexpr float kTexelRim = 0.05f, kTexelRimShade = 0.35f, kTexelRimLight = 0.03f;

}  // namespace vlf
