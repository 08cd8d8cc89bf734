// Distances along the light's axis, of objects and room, and the objects' opacity.
#include "shared.h"

#ifdef OBJECT
layout(location = kOpacityLocation) uniform float opacity;
#else
const float opacity = 0;
#endif

out vec4 color;

void main() {
    float distance_ = 1 / gl_FragCoord.w;
    color = vec4(distance_, opacity, distance_, 0);
}
