// The colour of a direction: as directionColor of render/drawing/direction_ball.cpp.
#include "shared.h"
#include "view.glsl"
#include "drawing_data.h"
#include "tone_map.glsl"

layout(std140, binding = kFigureBlock) uniform BallBlock { BallData ball; };
layout(binding = kDirectionUnit) uniform samplerBuffer directions;

in vec3 direction;
in vec2 weight;
flat in uvec3 corner;

out vec4 color;

void main() {
    vec3 d = normalize(direction);
    uint nearest = 0u;
    float farness = 1e30;
    // A triangle without obtuse angles holds the nearest direction at one of its corners.
    for (int i = 0; i < 3; ++i) {
        float r = distance(d, texelFetch(directions, 2 * int(corner[i])).xyz);
        if (r < farness) nearest = corner[i];
        farness = min(farness, r);
    }
    vec3 c = texelFetch(directions, 2 * int(nearest) + 1).rgb;
    if (min(min(weight.x, weight.y), 1 - weight.x - weight.y) < ball.style.y) c *= ball.style.z;
    if (farness < ball.style.x) c = ball.dots[nearest < uint(ball.style.w) ? 0 : 1].rgb;
    vec3 toEye = normalize(view.eye.xyz - ball.ball.xyz - ball.ball.w * d);
    c *= ball.shade.x + ball.shade.y * dot(d, toEye);
    color = shownColor(c);
}
