// The depth of the room or, OBJECT, of an object alone.
#include "shared.h"
#include "drawing.glsl"
#ifdef OBJECT
#include "object_place.glsl"
#endif

layout(location = kPositionAttribute) in vec3 position;

void main() {
#ifdef OBJECT
    vec3 world = placed(vec4(position, 1));
#else
    vec3 world = position;
#endif
    gl_Position = drawing.clipFromWorld * vec4(world, 1);
}
