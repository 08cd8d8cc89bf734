// Objects before what a mirror of the room shows by lookup: the reflection is traced among the
// objects alone, and the distances that are looked up say how far.
#include "hit_surface.glsl"

// Radiance of the nearest object on the way, and its distance; false if there is none.
bool objectOnTheWay(vec3 origin, vec3 direction, float tMax, out vec3 radiance, out float t) {
    TraceHit hit = TraceHit(kNoTriangle, tMax, vec2(0));
    int object = traceObjects(origin, direction, hit);
    t = hit.t;
    radiance = vec3(0);
    if (object < 0) return false;
    body = bodyOf(object);
    HitSurface s = surfaceAt(hit, toBody(body, direction));
    if (s.chart != kNoRecord) radiance = ownRadiance(s);
    body = kRoomBody;
    return true;
}

// `seen` is what the mirror shows without objects: a surface of radiance `front` at the distance
// `nearest` that covers so much of another one at the distance `behind`.
vec3 withObjects(vec3 seen, vec3 front, float nearest, float behind, float coverage, vec3 toEye) {
    vec3 n = normalize(mirrorNormal), direction = reflect(-toEye, n);
    if (dot(direction, geometricNormal) <= 0) direction = reflect(-toEye, geometricNormal);
    vec3 origin = position + view.eye.w * geometricNormal;
    float tMax = (coverage < 1 ? behind : nearest) + view.field.w;
    vec3 object;
    float t;
    if (!objectOnTheWay(origin, direction, tMax, object, t)) return seen;
    object *= material.mirror.rgb * texture(mirrorMap, uv, view.tone.z).rgb;
    return t < nearest + view.field.w ? object : mix(object, front, coverage);
}
