// What a mirror shows, by tracing its reflections; as render/cpu/field_shader.cpp.
#include "hit_surface.glsl"

layout(binding = kMirrorTriangleUnit) uniform usamplerBuffer mirrorTriangles;

const int kMaxReflections = 16;
const float kMinThroughput = 1e-4;

// The surface that is drawn, as if a ray had hit it.
TraceHit drawnSurface() {
    uint triangle = texelFetch(mirrorTriangles, int(material.flags.y) + gl_PrimitiveID).r;
    mat3 corners = cornersOf(hitRecord(2u * triangle));
    vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], p = position - corners[0];
    vec3 n = cross(e1, e2);
    vec2 barycentric = vec2(dot(cross(p, e2), n), dot(cross(e1, p), n)) / dot(n, n);
    return TraceHit(triangle, 0, barycentric);
}

vec3 mirrorRadiance() {
    vec3 direction = normalize(position - view.eye.xyz);
    vec3 seen = vec3(0), throughput = vec3(1);
    TraceHit hit = drawnSurface();
    for (int reflections = 0; reflections <= kMaxReflections; ++reflections) {
        HitSurface s = surfaceAt(hit, direction);
        if (s.chart == kNoRecord) break;
        if (reflections > 0) seen += throughput * ownRadiance(s);
        throughput *= mirrorReflectance(s);
        if (max(throughput.r, max(throughput.g, throughput.b)) < kMinThroughput) break;
        direction = mirrorDirection(s, direction);
        vec3 origin = s.position + view.eye.w * s.geometricNormal;
        if (reflections == kMaxReflections || !traceClosest(origin, direction, 0, hit)) break;
    }
    return seen;
}
