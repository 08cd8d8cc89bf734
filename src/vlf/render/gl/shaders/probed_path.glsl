// What mirrors of objects show without tracing the room: their reflection probes, and the objects
// before what these show; as dynamic/reflection_probe.cpp.
#include "path_step.glsl"

layout(binding = kProbeUnit) uniform samplerCubeArray probes;  // radiance, 1 / distance

const int kMostProbed = 4;  // reflections
const int kProbeSteps = 12;  // of equal angle along a ray
const int kProbeBisections = 4;  // of the step in which it meets a surface
const float kProbeGap = 0.1;  // of the distance: a longer way behind a surface is beside it

// A ray as the probe's centre sees it: its points by the angle from where it starts.
struct Sightline {
    vec3 start, direction;
    float across, first;
    float layer;
};

float alongSightline(Sightline l, float part) {
    return l.across * (tan(mix(l.first, 1.57079633, part)) - tan(l.first));
}

// How far a point lies behind what is seen in its direction, in units of that distance.
float behindProbe(Sightline l, float part) {
    vec3 q = l.start + alongSightline(l, part) * l.direction;
    return length(q) * textureLod(probes, vec4(q, l.layer), 0).a - 1;
}

// The distance along a ray, which starts at `start` from the probe's centre, of what it meets.
float probeDistance(vec3 start, vec3 direction, float layer) {
    float along = dot(start, direction);
    float across = sqrt(max(dot(start, start) - along * along, 1e-6 * dot(start, start)));
    Sightline l = Sightline(start, direction, across, atan(along, across), layer);
    const float end = 0.999;
    float near = 0, far = end, found = end;
    for (int i = 1; i <= kProbeSteps && found == end; ++i) {
        float next = end * float(i) / float(kProbeSteps);
        if (behindProbe(l, next) >= 0) {
            far = next;
            for (int k = 0; k < kProbeBisections; ++k) {
                float middle = 0.5 * (near + far);
                if (behindProbe(l, middle) >= 0) far = middle;
                else near = middle;
            }
            if (behindProbe(l, far) <= kProbeGap) found = far;
        }
        near = next;
    }
    return alongSightline(l, found);
}

// What is seen along a path that has been reflected by an object.
vec3 probedRadiance(int object, TracedPath path) {
    vec3 seen = vec3(0);
    for (int reflections = 1; reflections <= kMostProbed; ++reflections) {
        vec3 start = path.origin - uintBitsToFloat(objectRecord(object, 3)).xyz;
        float layer = float(bodyOf(object).probe);
        float distance_ = probeDistance(start, path.direction, layer);
        TraceHit hit = TraceHit(kNoTriangle, distance_ + objects.tolerance.x, vec2(0));
        object = traceObjects(path.origin, path.direction, hit);
        if (object < 0) {
            vec3 towards = start + distance_ * path.direction;
            seen += path.throughput * textureLod(probes, vec4(towards, layer), 0).rgb;
            break;
        }
        body = bodyOf(object);
        HitSurface s = surfaceAt(hit, toBody(body, path.direction));
        if (s.chart == kNoRecord) break;
        seen += path.throughput * ownRadiance(s);
        reflectPath(s, path);
        if (body.probe < 0 || isDark(path.throughput)) break;
    }
    body = kRoomBody;
    return seen;
}
