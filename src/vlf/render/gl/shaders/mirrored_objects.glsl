// Objects before what a mirror of the room shows by lookup: the reflection is traced among the
// objects alone, and the distances that are looked up say how far.
#include "path_step.glsl"
#ifdef PANE
#include "glass_split.glsl"
#endif
#ifdef PROBES
#include "probed_path.glsl"
#endif

// Radiance of an object that a path meets.
vec3 metRadiance(int object, TraceHit hit, TracedPath path) {
    vec3 radiance = vec3(0);
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
    return radiance;
}

vec3 reflectedShare(vec3 toEye) {
#ifdef PANE
    return vec3(paneReflectance(dot(geometricNormal, toEye), material.glass.w));
#else
    return material.mirror.rgb * textureLod(mirrorMap, uv, 0).rgb;
#endif
}

// `seen` is what the mirror shows without objects: a surface of radiance `front` at the distance
// `nearest` that covers so much of another one at the distance `behind`.
vec3 withObjects(vec3 seen, vec3 front, float nearest, float behind, float coverage, vec3 toEye) {
    vec3 direction = reflectedSight(toEye);
    TracedPath path =
        TracedPath(position + view.eye.w * geometricNormal, direction, vec3(1));
    vec3 change = changeOfLight(path.origin, direction, coverage < 0.5 ? behind : nearest);
    float tolerance = objects.tolerance.x;
#ifdef SHADOWS
    vec3 place = path.origin + (coverage < 0.5 ? behind : nearest) * direction;
    change *= remainingLight(place, 1, tolerance);
#endif
    TraceHit hit =
        TraceHit(kNoTriangle, (coverage < 1 ? behind : nearest) + tolerance, vec2(0));
    int object = traceObjects(path.origin, direction, hit);
    vec3 shown = seen * change;
    // A loop is skipped where no ray has met anything, unless it is seen to be none.
    while (object >= 0) {
        vec3 met = metRadiance(object, hit, path) * reflectedShare(toEye);
        shown = hit.t < nearest + tolerance ? met : mix(met, front * change, coverage);
        object = -1 - int(hit.triangle & 1u);
    }
    return shown;
}
