// What is seen where there is nothing.
#include "shared.h"
#include "view.glsl"
#include "tone_map.glsl"
#include "sky.glsl"

in vec3 direction;

out vec4 color;

void main() {
    color = outputColor(skyRadiance(normalize(direction)));
#ifdef PROBED
    color.a = 0;  // the inverse of the distance
#endif
}
