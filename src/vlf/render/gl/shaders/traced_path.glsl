// What a chain of reflections shows; as render/cpu/field_shader.cpp.
#include "path_step.glsl"

const int kMaxReflections = 16;

#ifdef OBJECTS
// The closest intersection in room and objects; makes what is hit the body.
bool traceAll(vec3 origin, vec3 direction, out TraceHit hit) {
    hit = TraceHit(kNoTriangle, 3.0e38, vec2(0.0));
    traceNearer(TraceBody(0, objects.counts.y, 0), origin, direction, 0, hit);
    int object = traceObjects(origin, direction, hit);
    body = kRoomBody;
    if (object >= 0) body = bodyOf(object);
    return hit.triangle != kNoTriangle;
}
#endif

// What is seen along a path that has been reflected once.
vec3 tracedRadiance(TracedPath path) {
    vec3 seen = vec3(0);
    TraceHit hit;
    for (int reflections = 1; reflections <= kMaxReflections; ++reflections) {
#ifdef OBJECTS
        if (isDark(path.throughput) || !traceAll(path.origin, path.direction, hit)) break;
        HitSurface s = surfaceAt(hit, toBody(body, path.direction));
#else
        if (isDark(path.throughput) || !traceClosest(path.origin, path.direction, 0, hit)) break;
        HitSurface s = surfaceAt(hit, path.direction);
#endif
        if (s.chart == kNoRecord) break;
        seen += path.throughput * ownRadiance(s);
        reflectPath(s, path);
    }
    return seen;
}
