// Vertices of the room.
#include "shared.h"
#include "view.glsl"

layout(location = kPositionAttribute) in vec3 positionIn;
layout(location = kUvAttribute) in vec2 uvIn;
layout(location = kAtlasUvAttribute) in vec2 atlasUvIn;
#if defined(MIRROR) || defined(SHADOWS)
out vec3 position;
#endif
#ifdef MIRROR
layout(location = kGeometricNormalAttribute) in vec2 geometricNormalIn;
layout(location = kMirrorAttribute) in uint mirrorIn;

flat out vec3 geometricNormal;
flat out uint mirror;
#if defined(OBJECTS) || defined(CHANGED)
layout(location = kMirrorNormalAttribute) in vec2 mirrorNormalIn;
out vec3 mirrorNormal;
#endif

#include "octahedron.glsl"
#endif
out vec2 uv;
out vec2 atlasUv;

// Variants of the shader draw the same mirror one after the other.
invariant gl_Position;

void main() {
    gl_Position = view.clipFromWorld * vec4(positionIn, 1);
    uv = uvIn;
    atlasUv = atlasUvIn;
#if defined(MIRROR) || defined(SHADOWS)
    position = positionIn;
#endif
#ifdef MIRROR
    geometricNormal = fromOctahedron(geometricNormalIn);
    mirror = mirrorIn;
#if defined(OBJECTS) || defined(CHANGED)
    mirrorNormal = fromOctahedron(mirrorNormalIn);
#endif
#endif
}
