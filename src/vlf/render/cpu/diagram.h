#pragma once
// Pictures that explain a light field's own structure.

#include "vlf/base/progress.h"
#include "vlf/field/light_field.h"
#include "vlf/image/image.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>
#include <optional>

namespace vlf {

enum class DiagramKind {
    directions,  ///< the direction set on its sphere: a cell per direction, coloured by its solid
                 ///< angle (blue: smaller than the mean, red: larger), the triangulation, and dots,
                 ///< dark for the upper of the two senses of a line
    subfield,    ///< one parallel subfield around the room: its tiles and a ray through each
    tile,        ///< one tile: its cells, its rays, and the charts they meet, each in its colour
    chart,       ///< the texels of one chart, coloured by irradiance from black to pale yellow
};

/// What is not given is chosen: a direction that shows well, the tile in the middle, the chart
/// in the middle of the picture.
struct DiagramParams {
    DiagramKind kind = DiagramKind::directions;
    std::optional<std::uint32_t> direction;  ///< oriented direction of the bake's direction set
    std::optional<std::uint32_t> tileX, tileY;
    std::optional<std::uint32_t> chart;
};

/// A diagram in display-linear colours. `directions` and `chart` lie over a dimmed picture from the
/// camera; `subfield` and `tile` look at the whole bounding sphere along the camera's line of
/// sight. Up to antialias² rays per pixel. Throws Cancelled, and InputError if a direction, tile or
/// chart is not in the field or the camera has no view.
Image drawDiagram(const Scene& scene, const RayScene& rays, const LightField& field,
                  const Camera& camera, int width, int height, int antialias,
                  const DiagramParams& params, Progress& progress, std::uint64_t& traced);

}  // namespace vlf
