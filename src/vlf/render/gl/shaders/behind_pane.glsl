// What a pane of glass shows of what is behind it, by tracing the line of sight straight on.
#include "traced_path.glsl"

vec3 behindPane() {
    vec3 sight = normalize(position - view.eye.xyz);
    float reflectance = paneReflectance(-dot(geometricNormal, sight), material.glass.w);
    return tracedRadiance(TracedPath(position - view.eye.w * geometricNormal, sight,
                                     (1 - reflectance) * material.glass.rgb));
}
