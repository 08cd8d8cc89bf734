// Adds a picture to the weighted sum of pictures, or shows their mean.
#include "shared.h"
#include "view.glsl"
#include "tone_map.glsl"

layout(binding = kPictureUnit) uniform sampler2D picture;
layout(location = kSizeLocation) uniform vec2 size;  // pixels of the picture, from its lower left
layout(location = kWeightLocation) uniform float weight;

in vec2 at;
out vec4 color;

void main() {
#ifdef ADD
    vec2 pixel = clamp(at * size, vec2(0.5), size - 0.5);
    color = weight * vec4(textureLod(picture, pixel / vec2(textureSize(picture, 0)), 0).rgb, 1);
#else
    vec4 sum = texelFetch(picture, ivec2(at * size), 0);
    color = outputColor(sum.rgb / max(sum.a, 1e-20));
#endif
}
