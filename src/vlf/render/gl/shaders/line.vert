// A line through space as two triangles around its image; six vertices a line. HIDING: the room
// hides lines, which are paler with distance. EDGES: the lines are edges of the mesh. NORMALS: they
// are shading normals, drawn on the side that is seen. OBJECT: they are in an object's space.
#include "shared.h"
#include "drawing.glsl"
#ifdef OBJECT
#include "object_place.glsl"
#else
vec3 placed(vec4 p) {
    return p.xyz;
}
#endif

layout(binding = kLineUnit) uniform samplerBuffer lines;
#ifdef NORMALS
layout(binding = kRoomDepthUnit) uniform sampler2D roomDepth;
#endif

flat out vec4 ends;       // pixels
flat out vec4 depths;     // at the ends: 1 / metres, then values of the depth buffer
flat out int pen;         // where the line is visible
flat out int hiddenPen;   // and where not; -1: none
flat out float paleness;  // of all of the line

const float kMargin = 4;  // pixels around the picture from which a thick line still shows

// Cuts t down to where (1 - t) a + t b >= 0; false if nothing is left.
bool clip(float a, float b, inout vec2 t) {
    if (a < 0 && b < 0) return false;
    if (a < 0) t.x = max(t.x, a / (a - b));
    if (b < 0) t.y = min(t.y, a / (a - b));
    return t.x <= t.y;
}

// The part of a line that lies within the picture, as render/cpu/projection.cpp cuts it.
bool clipToPicture(vec4 a, vec4 b, out vec2 t) {
    t = vec2(0, 1);
    float nearest = 1e-4 * max(abs(a.w), abs(b.w));
    if (!clip(a.w - nearest, b.w - nearest, t)) return false;
    vec2 most = 1 + 2 * kMargin / drawing.viewport.xy;
    for (int axis = 0; axis < 2; ++axis)
        if (!clip(most[axis] * a.w + a[axis], most[axis] * b.w + b[axis], t) ||
            !clip(most[axis] * a.w - a[axis], most[axis] * b.w - b[axis], t))
            return false;
    return true;
}

vec2 pixelOf(vec4 clip) {
    return (0.5 * clip.xy / clip.w + 0.5) * drawing.viewport.xy;
}

// Depth a little on the way to the eye, where the surface that the line lies on does not hide it.
float depthOf(vec4 clip) {
    float slack = drawing.stroke.z;
    float z = mix(clip.z, (drawing.clipFromWorld * vec4(drawing.eye.xyz, 1)).z, slack);
    return 0.5 * z / ((1 - slack) * clip.w) + 0.5;
}

#ifdef NORMALS
bool isHidden(vec4 clip) {
    vec2 pixel = pixelOf(clip);
    if (clip.w <= 0 || pixel != clamp(pixel, vec2(0), drawing.viewport.xy - 1)) return false;
    return depthOf(clip) > texelFetch(roomDepth, ivec2(pixel), 0).r;
}
#endif

void choosePens(int line, vec3 from) {
    pen = hiddenPen = -1;
#ifdef EDGES
    vec3 toEye = drawing.eye.xyz - from;
    bool crease = texelFetch(lines, kEdgeTexels * line).w != 0;
    vec4 a = vec4(texelFetch(lines, kEdgeTexels * line + 2).xyz, 0);
    vec4 b = vec4(texelFetch(lines, kEdgeTexels * line + 3).xyz, 0);
    bool contour = dot(placed(a), toEye) * dot(placed(b), toEye) < 0;
#ifdef HIDING
    pen = crease || contour ? kCreasePen : kTriangleEdgePen;
    if (crease) hiddenPen = kHiddenPen;
#else
    if (crease || contour) pen = kRoomEdgePen;
#endif
#else
    pen = int(texelFetch(lines, kLineTexels * line).w);
#endif
}

void main() {
    int line = gl_VertexID / 6, corner = gl_VertexID % 6;
#ifdef EDGES
    int at = kEdgeTexels * line;
#else
    int at = kLineTexels * line;
#endif
    vec3 from = placed(vec4(texelFetch(lines, at).xyz, 1));
    vec3 to = placed(vec4(texelFetch(lines, at + 1).xyz, 1));
    choosePens(line, from);
#ifdef NORMALS
    if (dot(to - from, drawing.eye.xyz - from) < 0) to = 2 * from - to;
#endif
    vec4 a = drawing.clipFromWorld * vec4(from, 1), b = drawing.clipFromWorld * vec4(to, 1);
    vec2 t;
    bool shown = clipToPicture(a, b, t) && pen >= 0;
#ifdef NORMALS
    shown = shown && !isHidden(a);
#endif
    if (!shown) {
        gl_Position = vec4(2, 2, 2, 1);
        return;
    }
    vec4 p = mix(a, b, t.x), q = mix(a, b, t.y);
    ends = vec4(pixelOf(p), pixelOf(q));
    depths = vec4(1 / (drawing.eye.w * vec2(p.w, q.w)), depthOf(p), depthOf(q));
    vec2 along = ends.zw - ends.xy;
    float length_ = length(along);
    paleness = 1;
#ifdef HIDING
    if (pen == kTriangleEdgePen) paleness = min(length_ / drawing.stroke.y, 1);
#endif
    along = length_ > 0 ? along / length_ : vec2(1, 0);
    float thickness = max(drawing.pens[pen].x, drawing.pens[max(hiddenPen, 0)].x);
    bool far = corner == 2 || corner == 4 || corner == 5;
    bool left = corner == 1 || corner == 3 || corner == 5;
    vec2 outwards = (far ? along : -along) + (left ? 1 : -1) * vec2(-along.y, along.x);
    vec2 pixel = (far ? ends.zw : ends.xy) + (0.5 * thickness + 0.5) * outwards;
    gl_Position = vec4(2 * pixel / drawing.viewport.xy - 1, 0, 1);
}
