// The room as glass: three vertices a triangle, positions and colours from a buffer.
#include "shared.h"
#include "view.glsl"
#include "drawing_data.h"

layout(std140, binding = kFigureBlock) uniform GlassBlock { GlassData glass; };

layout(location = kFigurePositionAttribute) in vec3 positionIn;
layout(location = kFigureDataAttribute) in vec4 frontColorIn;  // a: 0 where the tile does not meet the chart
layout(location = kFigureDataAttribute + 1) in vec4 backColorIn;

out vec2 cell;
out vec4 frontColor;
out vec4 backColor;

void main() {
    gl_Position = view.clipFromWorld * vec4(positionIn, 1);
    cell = vec2(dot(glass.xAxis.xyz, positionIn) + glass.xAxis.w,
                dot(glass.yAxis.xyz, positionIn) + glass.yAxis.w);
    frontColor = frontColorIn;
    backColor = backColorIn;
}
