#pragma once
// Read by C++ and GLSL: what shaders of drawings (modes wireframe and diagram) are told.

#ifdef __cplusplus
#include "vlf/math/vector.h"

namespace vlf::shared {
#define VLF_INT inline constexpr int
using vec4 = Vec4;
using mat4 = Mat4;
#else
#define VLF_INT const int
#endif

VLF_INT kMostPens = 12;
VLF_INT kMostSheets = 8;  // four to a texture

// Texture units.
VLF_INT kLineUnit = 3;        // lines, as texels of four floats
VLF_INT kRoomDepthUnit = 0;   // the depth of the room
VLF_INT kInkUnit = 0;         // and the next: ink by sheet
VLF_INT kPaperUnit = 2;       // what the sheets lie on, where it is a picture
VLF_INT kHeatUnit = 1;        // colours of irradiance
VLF_INT kDirectionUnit = 3;   // the direction set: two texels each, unit vector and colour

// Uniform blocks.
VLF_INT kDrawingBlock = 2;
VLF_INT kFigureBlock = 3;

// Texels of a line, and of an edge of the mesh, in kLineUnit. A line: one end and the pen, the other
// end. An edge: one end and whether it is a crease, the other end, the normals at its two sides.
VLF_INT kLineTexels = 2;
VLF_INT kEdgeTexels = 4;

// Attributes of vertices of the ball, the chart and the glass.
VLF_INT kFigurePositionAttribute = 0;
VLF_INT kFigureDataAttribute = 1;  // and the next

// Pens of a line drawing, as in render/drawing/wireframe_lines.h, and that of the room in diagrams.
VLF_INT kHiddenPen = 0;
VLF_INT kTriangleEdgePen = 1;
VLF_INT kCreasePen = 2;
VLF_INT kRoomEdgePen = 0;

// std140.
struct DrawingData {
    mat4 clipFromWorld;  // of lines: not moved by antialiasing
    vec4 eye;            // world; w: metres along the line of sight a unit of clip w
    vec4 viewport;       // pixels: width, height, and the place in the framebuffer
    vec4 stroke;         // pixels between tests of visibility, pixels of full strength, slack
    vec4 cue;            // metres: near and far end of the scene; strength at the far end
    vec4 paper;
    vec4 pens[kMostPens];      // thickness (pixels), strength, sheet
    vec4 sheets[kMostSheets];  // colours
};

// The ball of directions.
struct BallData {
    vec4 ball;      // centre, radius
    vec4 style;     // distance of a dot's edge, weight at a rim, shade of rims, lines
    vec4 shade;     // at the outline, and added where the ball faces the eye
    vec4 dots[2];   // colours: upper and lower sense
};

// The room as glass around a tile.
struct GlassData {
    vec4 xAxis;  // cell coordinates of the tile's subfield: axis and offset
    vec4 yAxis;
    vec4 tile;       // cells: lower and upper corner
    vec4 opacities;  // in the beam, of charts that the tile meets, of all else
    vec4 ink;        // colour of all else
};

// The texels of a chart.
struct TexelData {
    vec4 chart;  // atlas position of its first texel, size
    vec4 rim;    // width of a texel's rim, factor of its colour, added to that; brightest luminance
};

#ifdef __cplusplus
#undef VLF_INT
static_assert(sizeof(DrawingData) == 64 + 5 * 16 + 16 * (kMostPens + kMostSheets));
static_assert(sizeof(BallData) == 5 * 16);
static_assert(sizeof(GlassData) == 5 * 16);
static_assert(sizeof(TexelData) == 2 * 16);
}  // namespace vlf::shared
#endif
