// The room's depth alone.
#include "shared.h"
#include "drawing.glsl"

layout(location = kPositionAttribute) in vec3 position;

void main() {
    gl_Position = drawing.clipFromWorld * vec4(position, 1);
}
