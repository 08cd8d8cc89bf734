// A plain textured surface: what frame times are compared with.
#include "shared.h"
#include "view.glsl"

layout(binding = kDiffuseUnit) uniform sampler2D diffuseMap;

in vec2 uv;
in vec2 atlasUv;

out vec4 color;

void main() {
    color = material.diffuse * texture(diffuseMap, uv);
}
