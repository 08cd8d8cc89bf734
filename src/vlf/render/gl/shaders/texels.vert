// The triangles of one chart; in the same place as those of the room.
#include "shared.h"
#include "view.glsl"
#include "drawing_data.h"

layout(location = kFigurePositionAttribute) in vec3 positionIn;
layout(location = kFigureDataAttribute) in vec2 texelIn;

out vec2 texel;

void main() {
    gl_Position = view.clipFromWorld * vec4(positionIn, 1);
    texel = texelIn;
}
