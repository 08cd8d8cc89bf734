// What a mirror of the room shows, by tracing its reflections; or glass, with what it transmits.
#include "traced_path.glsl"

layout(binding = kMirrorTriangleUnit) uniform usamplerBuffer mirrorTriangles;

// The surface that is drawn, as if a ray had hit it.
TraceHit drawnSurface() {
    uint triangle = texelFetch(mirrorTriangles, int(material.flags.y) + gl_PrimitiveID).r;
    mat3 corners = cornersOf(hitRecord(2u * triangle));
    vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], p = position - corners[0];
    vec3 n = cross(e1, e2);
    vec2 barycentric = vec2(dot(cross(p, e2), n), dot(cross(e1, p), n)) / dot(n, n);
    return TraceHit(triangle, 0, barycentric);
}

#ifdef GLASS
vec3 mirrorRadiance() {
    vec3 sight = normalize(position - view.eye.xyz);
    HitSurface s = surfaceAt(drawnSurface(), sight);
    if (s.chart == kNoRecord) return vec3(0);
    GlassSplit g = splitAtGlass(s, sight);
    vec3 seen = vec3(0);
    for (int branch = 0; branch < 2; ++branch) {
        TracedPath path = TracedPath(position, sight, vec3(1));
        followGlass(s, g, branch == 1, path);
        seen += tracedRadiance(path);
    }
    return seen;
}
#else
vec3 mirrorRadiance() {
    TracedPath path = TracedPath(position, normalize(position - view.eye.xyz), vec3(1));
    HitSurface s = surfaceAt(drawnSurface(), path.direction);
    if (s.chart == kNoRecord) return vec3(0);
    reflectPath(s, path);
    return tracedRadiance(path);
}
#endif
