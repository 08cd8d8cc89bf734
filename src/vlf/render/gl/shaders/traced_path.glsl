// What a chain of reflections shows; as render/cpu/field_shader.cpp.
#include "path_step.glsl"
#ifdef SKY
#include "sky.glsl"
#endif
#include "glass_step.glsl"

const int kMaxReflections = 16;

// The closest intersection in room and objects; makes what is hit the body.
bool traceAll(vec3 origin, vec3 direction, out TraceHit hit) {
    hit = TraceHit(kNoTriangle, 3.0e38, vec2(0.0));
    traceNearer(TraceBody(0, view.trace.x, 0), origin, direction, 0, hit);
#ifdef OBJECTS
    int object = traceObjects(origin, direction, hit);
    body = kRoomBody;
    if (object >= 0) body = bodyOf(object);
#endif
    return hit.triangle != kNoTriangle;
}

// What is seen along a path that has been reflected or has passed glass once.
vec3 tracedRadiance(TracedPath path) {
    vec3 seen = vec3(0);
    TraceHit hit;
    for (int reflections = 1; reflections <= kMaxReflections; ++reflections) {
        if (isDark(path.throughput)) break;
        if (!traceAll(path.origin, path.direction, hit)) {
#ifdef SKY
            seen += path.throughput * skyRadiance(path.direction);
#endif
            break;
        }
#ifdef OBJECTS
        HitSurface s = surfaceAt(hit, toBody(body, path.direction));
#else
        HitSurface s = surfaceAt(hit, path.direction);
#endif
        if (s.chart == kNoRecord) break;
#ifdef SHADOWS
        if (body.object < 0) path.throughput *= remainingOn(s.position, s.geometricNormal);
#endif
        if (isGlass(s)) {
            passGlass(s, path);
        } else {
            seen += path.throughput * ownRadiance(s);
            reflectPath(s, path);
        }
    }
#ifdef OBJECTS
    body = kRoomBody;
#endif
    return seen;
}
