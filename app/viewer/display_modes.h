#pragma once
// What the walkthrough can show; a row each.

#include "vlf/render/gl/renderer.h"

#include <array>

namespace vlf::app {

struct ViewMode {
    const char* name;
    const char* help;
    DisplayMode mode;
    DiagramKind diagram = DiagramKind::directions;
    bool normals = false;
};

inline constexpr std::array kViewModes{
    ViewMode{"field", "diffuse light and mirrors from the field", DisplayMode::field},
    ViewMode{"progressive", "as field in motion; at rest reflections are traced, edges smoothed",
             DisplayMode::progressive},
    ViewMode{"raytraced", "reflections traced in every frame", DisplayMode::raytraced},
    ViewMode{"wireframe", "the triangles as lines", DisplayMode::wireframe},
    ViewMode{"normals", "wireframe with shading normals", DisplayMode::wireframe,
             DiagramKind::directions, true},
    ViewMode{"directions", "the direction set on its sphere", DisplayMode::diagram,
             DiagramKind::directions},
    ViewMode{"subfield", "one parallel subfield around the room", DisplayMode::diagram,
             DiagramKind::subfield},
    ViewMode{"tile", "one tile, its rays and the charts they meet", DisplayMode::diagram,
             DiagramKind::tile},
    ViewMode{"chart", "the texels of the chart that was in the middle", DisplayMode::diagram,
             DiagramKind::chart},
};

}  // namespace vlf::app
