// What a mirror on an object shows, by its reflection probe.
#include "probed_path.glsl"
#include "object_mirror.glsl"

layout(location = kObjectLocation) uniform int object;

vec3 mirrorRadiance() {
    ObjectMirror m = objectMirror();
    return probedRadiance(object,
                          TracedPath(position + view.eye.w * m.side, m.direction, vec3(1)));
}
