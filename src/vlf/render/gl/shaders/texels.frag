// The texels of one chart, each with a rim, coloured by irradiance.
#include "shared.h"
#include "view.glsl"
#include "drawing_data.h"
#include "tone_map.glsl"

layout(std140, binding = kFigureBlock) uniform TexelBlock { TexelData texels; };
layout(binding = kIrradianceUnit) uniform sampler2D irradianceAtlas;
layout(binding = kHeatUnit) uniform sampler2D heat;

in vec2 texel;

out vec4 color;

void main() {
    vec2 t = clamp(texel, vec2(0), texels.chart.zw - 0.001);
    vec2 within = fract(t);
    vec3 irradiance = texelFetch(irradianceAtlas, ivec2(texels.chart.xy + floor(t)), 0).rgb;
    float share = dot(irradiance, vec3(0.2126, 0.7152, 0.0722)) / texels.rim.w;
    float last = float(textureSize(heat, 0).x - 1);
    vec3 c = texture(heat, vec2((clamp(share, 0, 1) * last + 0.5) / (last + 1), 0.5)).rgb;
    vec2 toRim = min(within, 1 - within);
    if (min(toRim.x, toRim.y) < texels.rim.x) c = texels.rim.y * c + texels.rim.z;
    color = shownColor(c);
}
