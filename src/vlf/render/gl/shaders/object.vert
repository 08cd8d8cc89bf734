// Vertices of an object. BY_TEXEL: it is lit by texel, otherwise by vertex.
#include "shared.h"
#include "view.glsl"

layout(location = kPositionAttribute) in vec3 positionIn;
layout(location = kUvAttribute) in vec2 uvIn;
#ifdef BY_TEXEL
layout(location = kAtlasUvAttribute) in vec2 atlasTexelIn;
out vec2 atlasTexel;
#else
layout(location = kMirrorAttribute) in uint lightIn;
out vec3 vertexIrradiance;
#endif
#ifdef MIRROR
#include "octahedron.glsl"
layout(location = kMirrorNormalAttribute) in vec2 normalIn;
out vec3 position;
out vec3 normal;
#endif
out vec2 uv;

layout(binding = kVertexLightUnit) uniform samplerBuffer vertexLight;
layout(location = kLightLocation) uniform ivec4 light;
#include "object_place.glsl"

void main() {
    vec3 world = placed(vec4(positionIn, 1));
    gl_Position = view.clipFromWorld * vec4(world, 1);
    uv = uvIn;
#ifdef BY_TEXEL
    atlasTexel = vec2(light.xy) + atlasTexelIn;
#else
    vertexIrradiance = texelFetch(vertexLight, light.z + int(lightIn)).rgb;
#endif
#ifdef MIRROR
    position = world;
    normal = placed(vec4(fromOctahedron(normalIn), 0));
#endif
}
