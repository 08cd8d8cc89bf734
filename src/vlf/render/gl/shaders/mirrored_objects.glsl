// Objects before what a mirror of the room shows by lookup: the reflection is traced among the
// objects alone, and the distances that are looked up say how far.
#include "path_step.glsl"
#include "changed_light.glsl"
#ifdef PROBES
#include "probed_path.glsl"
#endif

// Radiance of the nearest object on the way, and its distance; false if there is none.
bool objectOnTheWay(TracedPath path, float tMax, out vec3 radiance, out float t) {
    TraceHit hit = TraceHit(kNoTriangle, tMax, vec2(0));
    int object = traceObjects(path.origin, path.direction, hit);
    t = hit.t;
    radiance = vec3(0);
    if (object < 0) return false;
    body = bodyOf(object);
    HitSurface s = surfaceAt(hit, toBody(body, path.direction));
    if (s.chart != kNoRecord) {
        radiance = ownRadiance(s);
#ifdef PROBES
        reflectPath(s, path);
        if (body.probe >= 0 && !isDark(path.throughput)) radiance += probedRadiance(object, path);
#endif
    }
    body = kRoomBody;
    return true;
}

// `seen` is what the mirror shows without objects: a surface of radiance `front` at the distance
// `nearest` that covers so much of another one at the distance `behind`.
vec3 withObjects(vec3 seen, vec3 front, float nearest, float behind, float coverage, vec3 toEye) {
    vec3 n = normalize(mirrorNormal), direction = reflect(-toEye, n);
    if (dot(direction, geometricNormal) <= 0) direction = reflect(-toEye, geometricNormal);
    vec3 origin = position + view.eye.w * geometricNormal;
    float tolerance = objects.tolerance.x;
    vec3 object;
    float t;
    bool met = objectOnTheWay(TracedPath(origin, direction, vec3(1)),
                              (coverage < 1 ? behind : nearest) + tolerance, object, t);
    object *= material.mirror.rgb * texture(mirrorMap, uv, view.tone.z).rgb;
    vec3 change = changeOfLight(origin, direction, coverage < 0.5 ? behind : nearest);
    if (!met) return seen * change;
    return t < nearest + tolerance ? object : mix(object, front * change, coverage);
}
