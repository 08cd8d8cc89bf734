// What a mirror on an object shows, by its reflection probe.
#include "probed_path.glsl"
#include "object_mirror.glsl"

layout(location = kLightLocation) uniform ivec4 light;

vec3 mirrorRadiance() {
    ObjectMirror m = objectMirror();
    return probedRadiance(light.w,
                          TracedPath(position + view.eye.w * m.side, m.direction, vec3(1)));
}
