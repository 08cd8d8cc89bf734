// Sheets of ink on paper. SHEETS: how many; PICTURE: the paper is a picture.
#include "shared.h"
#include "view.glsl"
#include "drawing.glsl"
#include "tone_map.glsl"

layout(binding = kInkUnit) uniform sampler2D ink;
layout(binding = kInkUnit + 1) uniform sampler2D moreInk;
#ifdef PICTURE
layout(binding = kPaperUnit) uniform sampler2D picture;
#endif

out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy - drawing.viewport.zw);
    vec3 c = drawing.paper.rgb;
#ifdef PICTURE
    c = texelFetch(picture, pixel, 0).rgb;
#endif
    vec4 inks = texelFetch(ink, pixel, 0);
    for (int i = 0; i < min(SHEETS, 4); ++i) c = mix(c, drawing.sheets[i].rgb, inks[i]);
#if SHEETS > 4
    inks = texelFetch(moreInk, pixel, 0);
    for (int i = 4; i < SHEETS; ++i) c = mix(c, drawing.sheets[i].rgb, inks[i - 4]);
#endif
    color = shownColor(c);
}
