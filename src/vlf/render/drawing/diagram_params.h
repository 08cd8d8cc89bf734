#pragma once
// Which diagram of a light field to draw.

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

/// Of the room beneath the diagrams `directions` and `chart`, in display-linear colours.
inline constexpr float kDimmed = 0.3f;

}  // namespace vlf
