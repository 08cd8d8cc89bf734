// A surface of the baked room: what it emits, the light of the irradiance atlas it reflects, and
// what is seen in it where it is a mirror.
#include "shared.h"
#include "view.glsl"
#include "tone_map.glsl"

layout(binding = kIrradianceUnit) uniform sampler2D irradianceAtlas;
layout(binding = kDiffuseUnit) uniform sampler2D diffuseMap;
layout(binding = kEmissionUnit) uniform sampler2D emissionMap;

in vec2 uv;
in vec2 atlasUv;
#if defined(MIRROR) || defined(SHADOWS)
in vec3 position;
#endif
#ifdef SHADOWS
#include "hard_shadow.glsl"
#endif
#ifdef MIRROR
flat in vec3 geometricNormal;
flat in uint mirror;
#if defined(OBJECTS) || defined(CHANGED)
layout(binding = kMirrorMapUnit) uniform sampler2D mirrorMap;
in vec3 mirrorNormal;
#endif
// First, as it includes what the other one may leave out.
#include BEHIND
#include MIRROR
#endif

out vec4 color;

void main() {
    if (material.flags.x != 0 && !gl_FrontFacing) {
        color = vec4(0, 0, 0, 1);
        return;
    }
    vec3 diffuse = material.diffuse.rgb;
#ifdef DIFFUSE_MAP
    diffuse *= texture(diffuseMap, uv, view.tone.z).rgb;
#endif
    vec3 radiance = diffuse * texture(irradianceAtlas, atlasUv).rgb * 0.318309886;
#ifdef EMISSION
    radiance += material.emission.rgb * texture(emissionMap, uv, view.tone.z).rgb;
#endif
#ifdef MIRROR
    radiance += mirrorRadiance();
#ifdef BEHIND
    radiance += behindPane();
#endif
#endif
#ifdef SHADOWS
    vec3 side = normalize(cross(dFdx(position), dFdy(position)));
    if (dot(side, view.eye.xyz - position) < 0) side = -side;
    radiance *= remainingOn(position, side);
#endif
    color = outputColor(radiance);
#ifdef PROBED
    // The inverse of the distance; the picture is a face of a cube.
    vec2 onFace = 2 * gl_FragCoord.xy / PROBED - 1;
    color.a = gl_FragCoord.w / length(vec3(onFace, 1));
#endif
}
