// A pane of glass: charts that the tile meets coloured, most of all within its beam.
#include "shared.h"
#include "drawing_data.h"

layout(std140, binding = kFigureBlock) uniform GlassBlock { GlassData glass; };

in vec2 cell;
in vec4 frontColor;
in vec4 backColor;

out vec4 color;

void main() {
    vec4 chart = gl_FrontFacing ? frontColor : backColor;
    bool inTile = all(greaterThanEqual(cell, glass.tile.xy)) && all(lessThan(cell, glass.tile.zw));
    color = chart.a > 0.5 ? vec4(chart.rgb, inTile ? glass.opacities.x : glass.opacities.y)
                          : vec4(glass.ink.rgb, glass.opacities.z);
}
