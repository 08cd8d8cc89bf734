// One triangle over all of the view, behind everything, and where its pixels look.
#include "shared.h"
#include "view.glsl"

out vec3 direction;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1);
    direction = corner.x * view.skyRight.xyz + corner.y * view.skyUp.xyz + view.skyAhead.xyz;
    gl_Position = vec4(corner, 1, 1);
}
