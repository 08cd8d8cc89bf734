// The ink of a line: coverage of the pixel times strength, in the channel of the pen's sheet.
#include "shared.h"
#include "drawing.glsl"

#ifdef HIDING
layout(binding = kRoomDepthUnit) uniform sampler2D roomDepth;
#endif

flat in vec4 ends;
flat in vec4 depths;
flat in int pen;
flat in int hiddenPen;
flat in float paleness;

layout(location = 0) out vec4 ink;
layout(location = 1) out vec4 moreInk;

#ifdef HIDING
// All of a stroke is visible or all of it hidden, by the room's depth at its middle. Of a contour
// the nearest of four pixels may show the surface before it turns away, or what is beside it.
bool isHidden(float s) {
    vec2 point = clamp(mix(ends.xy, ends.zw, s), vec2(0.5), drawing.viewport.xy - 0.5);
    float depth = mix(depths.z, depths.w, s);
    bool contour = pen == kCreasePen && hiddenPen < 0;
    if (contour)
        return all(greaterThan(vec4(depth),
                               textureGather(roomDepth, point / vec2(textureSize(roomDepth, 0)))));
    return depth > texelFetch(roomDepth, ivec2(point), 0).r;
}

float depthCue(float s) {
    float depth = 1 / mix(depths.x, depths.y, s);
    float t = clamp((depth - drawing.cue.x) / max(drawing.cue.y - drawing.cue.x, 1e-20), 0, 1);
    return mix(1, drawing.cue.z, t * t);
}
#endif

void main() {
    vec2 p = gl_FragCoord.xy - ends.xy, along = ends.zw - ends.xy;
    float length2 = dot(along, along);
    float s = length2 > 0 ? clamp(dot(p, along) / length2, 0, 1) : 0;
    float distance_ = length(p - s * along);
    int chosen = pen;
    float strength = paleness;
#ifdef HIDING
    float strokes = max(ceil(sqrt(length2) / drawing.stroke.x), 1);
    float middle = (min(floor(s * strokes), strokes - 1) + 0.5) / strokes;
    if (isHidden(middle)) chosen = hiddenPen;
    strength *= depthCue(middle);
#endif
    ink = moreInk = vec4(0);
    if (chosen < 0) return;
    vec4 style = drawing.pens[chosen];
    float coverage = clamp(0.5 * style.x + 0.5 - distance_, 0, min(style.x, 1));
    strength *= coverage * style.y;
    ink = strength * vec4(equal(vec4(0, 1, 2, 3), vec4(style.z)));
    moreInk = strength * vec4(equal(vec4(4, 5, 6, 7), vec4(style.z)));
}
