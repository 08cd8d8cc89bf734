// Reflections one by one.
#include "hit_surface.glsl"

const float kMinThroughput = 1e-4;

// A ray on its way, and what it has met.
struct TracedPath {
    vec3 origin, direction;
    vec3 throughput;
};

float maxOf(vec3 v) {
    return max(v.r, max(v.g, v.b));
}

bool isDark(vec3 throughput) {
    return maxOf(throughput) < kMinThroughput;
}

// Reflects the path, which has come to a surface.
void reflectPath(HitSurface s, inout TracedPath path) {
    path.throughput *= mirrorReflectance(s);
#ifdef OBJECTS
    path.direction = normalize(body.axes * mirrorDirection(s, toBody(body, path.direction)));
    path.origin = body.axes * s.position + body.origin +
                  view.eye.w * normalize(body.axes * s.geometricNormal);
#else
    path.direction = mirrorDirection(s, path.direction);
    path.origin = s.position + view.eye.w * s.geometricNormal;
#endif
}
