// The room or, OBJECT, an object as the light of hard shadows sees it.
#include "shared.h"
#ifdef OBJECT
#include "object_place.glsl"
#endif

layout(std140, binding = kShadowBlock) uniform ShadowBlock { ShadowData shadow; };
layout(location = kPositionAttribute) in vec3 position;

void main() {
#ifdef OBJECT
    vec3 world = placed(vec4(position, 1));
#else
    vec3 world = position;
#endif
    gl_Position = shadow.clipFromWorld * vec4(world, 1);
}
