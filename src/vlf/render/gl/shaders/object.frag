// The surface of an object: what it emits, the light on it that it reflects, and what is seen in it
// where it is a mirror.
#include "shared.h"
#include "view.glsl"
#include "tone_map.glsl"

layout(binding = kDiffuseUnit) uniform sampler2D diffuseMap;
layout(binding = kEmissionUnit) uniform sampler2D emissionMap;
layout(binding = kMirrorMapUnit) uniform sampler2D mirrorMap;

in vec2 uv;
#ifdef BY_TEXEL
in vec2 atlasTexel;
#else
in vec3 vertexIrradiance;
#endif
#ifdef MIRROR
in vec3 position;
in vec3 normal;
layout(binding = kIrradianceUnit) uniform sampler2D irradianceAtlas;
#ifdef SHADOWS
#include "hard_shadow.glsl"
#endif
#include MIRROR
#elif defined(BY_TEXEL)
layout(binding = kObjectAtlasUnit) uniform sampler2D objectAtlas;
#endif

out vec4 color;

vec3 irradianceHere() {
#ifdef BY_TEXEL
    return texture(objectAtlas, atlasTexel / vec2(textureSize(objectAtlas, 0))).rgb;
#else
    return vertexIrradiance;
#endif
}

void main() {
    if (material.flags.x != 0 && !gl_FrontFacing) {
        color = vec4(0, 0, 0, 1);
        return;
    }
    vec3 diffuse = material.diffuse.rgb;
#ifdef DIFFUSE_MAP
    diffuse *= texture(diffuseMap, uv, view.tone.z).rgb;
#endif
    vec3 radiance = diffuse * irradianceHere() * 0.318309886;
#ifdef EMISSION
    radiance += material.emission.rgb * texture(emissionMap, uv, view.tone.z).rgb;
#endif
#ifdef MIRROR
    radiance += material.mirror.rgb * texture(mirrorMap, uv, view.tone.z).rgb * mirrorRadiance();
#endif
    color = outputColor(radiance);
}
