// What a mirror on an object shows, by tracing its reflections.
#include "traced_path.glsl"
#include "object_mirror.glsl"

vec3 mirrorRadiance() {
    ObjectMirror m = objectMirror();
    return tracedRadiance(TracedPath(position + view.eye.w * m.side, m.direction, vec3(1)));
}
