// Vertices of the room.
#include "shared.h"
#include "view.glsl"

layout(location = kPositionAttribute) in vec3 positionIn;
layout(location = kUvAttribute) in vec2 uvIn;
layout(location = kAtlasUvAttribute) in vec2 atlasUvIn;
#ifdef MIRROR
layout(location = kGeometricNormalAttribute) in vec2 geometricNormalIn;
layout(location = kMirrorAttribute) in uint mirrorIn;

out vec3 position;
flat out vec3 geometricNormal;
flat out uint mirror;

vec3 fromOctahedron(vec2 e) {
    vec3 v = vec3(e, 1 - abs(e.x) - abs(e.y));
    if (v.z < 0) v.xy = (1 - abs(v.yx)) * vec2(v.x < 0 ? -1 : 1, v.y < 0 ? -1 : 1);
    return normalize(v);
}
#endif
out vec2 uv;
out vec2 atlasUv;

void main() {
    gl_Position = view.clipFromWorld * vec4(positionIn, 1);
    uv = uvIn;
    atlasUv = atlasUvIn;
#ifdef MIRROR
    position = positionIn;
    geometricNormal = fromOctahedron(geometricNormalIn);
    mirror = mirrorIn;
#endif
}
