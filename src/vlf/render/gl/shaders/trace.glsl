// Ray queries in the hierarchy of trace/bvh.h, whose nodes and triangles two texture buffers of
// four floats a texel hold: four texels a node, three a triangle. To be included in a shader.

uniform samplerBuffer bvhNodes;
uniform samplerBuffer bvhTriangles;

const int kBvhMaxDepth = 48;         // Bvh::kMaxDepth
const uint kBvhRoot = 0x40000000u;   // see BvhReference
const uint kBvhLeaf = 0x80000000u;
const uint kBvhIndex = 0x07ffffffu;
const uint kBvhNothing = 0u;         // no reference is 0
const float kBvhFar = 3.0e38;

// The closest intersection: the scene's triangle, the distance in units of the direction's length,
// the weights of the second and third vertex.
struct TraceHit {
    uint triangle;
    float t;
    vec2 barycentric;
};

// 1 / d without the infinities that would make 0 * inf of a ray in the plane of a box's side.
vec3 safeReciprocal(vec3 d) {
    return 1.0 / mix(d, vec3(1.0e-20), lessThan(abs(d), vec3(1.0e-20)));
}

// Distance at which the ray enters a box, kBvhFar if it misses it within (tMin, tMax).
float enterBox(vec3 lower, vec3 upper, vec3 origin, vec3 reciprocal, float tMin, float tMax) {
    vec3 a = (lower - origin) * reciprocal, b = (upper - origin) * reciprocal;
    vec3 near = min(a, b), far = max(a, b);
    float enter = max(max(near.x, near.y), max(near.z, tMin));
    float leave = min(min(far.x, far.y), min(far.z, tMax));
    return enter <= leave ? enter : kBvhFar;
}

// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 1997.
void hitTriangle(int index, vec3 origin, vec3 direction, float tMin, inout TraceHit hit) {
    vec4 v0 = texelFetch(bvhTriangles, 3 * index);
    vec3 e1 = texelFetch(bvhTriangles, 3 * index + 1).xyz;
    vec3 e2 = texelFetch(bvhTriangles, 3 * index + 2).xyz;
    vec3 p = cross(direction, e2);
    float scale = 1.0 / dot(e1, p);
    vec3 s = origin - v0.xyz;
    float u = dot(s, p) * scale;
    vec3 q = cross(s, e1);
    float v = dot(direction, q) * scale;
    float t = dot(e2, q) * scale;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > tMin && t < hit.t)
        hit = TraceHit(floatBitsToUint(v0.w) & kBvhIndex, t, vec2(u, v));
}

bool traceClosest(vec3 origin, vec3 direction, float tMin, out TraceHit hit) {
    vec3 reciprocal = safeReciprocal(direction);
    hit = TraceHit(0xffffffffu, kBvhFar, vec2(0.0));
    uint aside[kBvhMaxDepth];
    int count = 0;
    uint current = kBvhRoot;
    while (current != kBvhNothing) {
        uint next = kBvhNothing;
        if ((current & kBvhLeaf) == 0u) {
            int node = 4 * int(current & kBvhIndex);
            vec4 lower0 = texelFetch(bvhNodes, node), upper0 = texelFetch(bvhNodes, node + 1);
            vec4 lower1 = texelFetch(bvhNodes, node + 2), upper1 = texelFetch(bvhNodes, node + 3);
            float t0 = enterBox(lower0.xyz, upper0.xyz, origin, reciprocal, tMin, hit.t);
            float t1 = enterBox(lower1.xyz, upper1.xyz, origin, reciprocal, tMin, hit.t);
            uint r0 = floatBitsToUint(lower0.w), r1 = floatBitsToUint(lower1.w);
            if (max(t0, t1) < kBvhFar) aside[count++] = t1 < t0 ? r0 : r1;
            if (min(t0, t1) < kBvhFar) next = t1 < t0 ? r1 : r0;
        } else {
            int first = int(current & kBvhIndex), n = int(current >> 27 & 7u);
            for (int i = 0; i < n; ++i) hitTriangle(first + i, origin, direction, tMin, hit);
        }
        if (next == kBvhNothing && count > 0) next = aside[--count];
        current = next;
    }
    return hit.triangle != 0xffffffffu;
}
