// The ball of directions.
#include "shared.h"
#include "view.glsl"
#include "drawing_data.h"

layout(std140, binding = kFigureBlock) uniform BallBlock { BallData ball; };

layout(location = kFigurePositionAttribute) in vec3 positionIn;
layout(location = kFigureDataAttribute) in vec2 weightIn;
layout(location = kFigureDataAttribute + 1) in uvec3 cornerIn;

out vec3 direction;
out vec2 weight;
flat out uvec3 corner;

void main() {
    direction = positionIn;
    weight = weightIn;
    corner = cornerIn;
    gl_Position = view.clipFromWorld * vec4(ball.ball.xyz + ball.ball.w * positionIn, 1);
}
