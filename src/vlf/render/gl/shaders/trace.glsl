// Ray queries in the hierarchy of trace/bvh.h, held by two texture buffers of format RGBA32F: two
// texels a node, three a triangle.
//
// Both queries are one walk forward. The loop over boxes within it runs until every ray of a group
// that goes in step has come to a leaf: triangles are tested seldom, and by many rays at once.

#include "shared.h"

layout(binding = kBvhNodeUnit) uniform samplerBuffer bvhNodes;
layout(binding = kBvhTriangleUnit) uniform samplerBuffer bvhTriangles;

const uint kBvhIndex = 0x07ffffffu;  // bits of a word that are an index
const uint kNoTriangle = 0xffffffffu;

// Triangles reach a little over their edges (in parts of their size), so that rounding lets no ray
// through between two of them.
const float kTraceOverlap = 1.0e-5;

// The closest intersection. `barycentric` are the weights of the second and third vertex.
struct TraceHit {
    uint triangle;  // of the scene; kNoTriangle: none
    float t;        // in units of the direction's length
    vec2 barycentric;
};

// A hierarchy among those that the buffers hold one behind the other; each counts from its own
// first node and triangle.
struct TraceBody {
    int firstNode, nodes, firstTriangle;
};

TraceBody onlyBody() {
    return TraceBody(0, textureSize(bvhNodes) / 2, 0);
}

// A query on its way.
struct TraceWalk {
    vec3 origin, direction, reciprocal;
    float tMin;
    int at, end;  // the node to visit next, and that behind the last one
    int firstNode, firstTriangle;
};

TraceWalk beginWalk(TraceBody body, vec3 origin, vec3 direction, float tMin) {
    // 1 / 0 would make 0 * inf of a ray in the plane of a box's side.
    vec3 d = mix(direction, vec3(1.0e-20), lessThan(abs(direction), vec3(1.0e-20)));
    return TraceWalk(origin, direction, 1.0 / d, tMin, body.firstNode, body.firstNode + body.nodes,
                     body.firstNode, body.firstTriangle);
}

// Goes on to the next leaf whose box the ray is in somewhere in (tMin, tMax) and returns its word,
// see BvhNode; 0 if there is none.
uint nextLeaf(inout TraceWalk walk, float tMax) {
    uint leaf = 0u;
    while (walk.at < walk.end && leaf == 0u) {
        vec4 lower = texelFetch(bvhNodes, 2 * walk.at);
        vec4 upper = texelFetch(bvhNodes, 2 * walk.at + 1);
        vec3 a = (lower.xyz - walk.origin) * walk.reciprocal;
        vec3 b = (upper.xyz - walk.origin) * walk.reciprocal;
        vec3 near = min(a, b), far = max(a, b);
        bool entered = max(max(near.x, near.y), max(near.z, walk.tMin)) <=
                       min(min(far.x, far.y), min(far.z, tMax));
        uint word = floatBitsToUint(upper.w);
        bool inner = entered && word == 0u;
        walk.at = inner ? walk.at + 1
                        : walk.firstNode + int(floatBitsToUint(lower.w) & kBvhIndex);
        if (entered) leaf = word;
    }
    return leaf;
}

// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 1997. `index` counts
// in the order of the leaves.
void hitTriangle(TraceWalk walk, int index, inout TraceHit hit) {
    vec4 v0 = texelFetch(bvhTriangles, 3 * index);
    vec3 e1 = texelFetch(bvhTriangles, 3 * index + 1).xyz;
    vec3 e2 = texelFetch(bvhTriangles, 3 * index + 2).xyz;
    vec3 p = cross(walk.direction, e2);
    float scale = 1.0 / dot(e1, p);
    vec3 s = walk.origin - v0.xyz;
    vec3 q = cross(s, e1);
    float u = dot(s, p) * scale, v = dot(walk.direction, q) * scale, t = dot(e2, q) * scale;
    if (min(u, v) >= -kTraceOverlap && u + v <= 1.0 + kTraceOverlap && t > walk.tMin && t < hit.t)
        hit = TraceHit(floatBitsToUint(v0.w) & kBvhIndex, t, vec2(u, v));
}

void hitLeaf(TraceWalk walk, uint leaf, inout TraceHit hit) {
    int first = walk.firstTriangle + int(leaf & kBvhIndex), count = int(leaf >> 27 & 7u);
    for (int i = 0; i < count; ++i) hitTriangle(walk, first + i, hit);
}

// The closest intersection of a body beyond tMin, if it is nearer than `hit`; false if there is none.
bool traceNearer(TraceBody body, vec3 origin, vec3 direction, float tMin, inout TraceHit hit) {
    float before = hit.t;
    TraceWalk walk = beginWalk(body, origin, direction, tMin);
    while (walk.at < walk.end) {
        uint leaf = nextLeaf(walk, hit.t);
        hitLeaf(walk, leaf, hit);
    }
    return hit.t < before;
}

// The closest intersection beyond tMin; false if there is none.
bool traceClosest(vec3 origin, vec3 direction, float tMin, out TraceHit hit) {
    hit = TraceHit(kNoTriangle, 3.0e38, vec2(0.0));
    return traceNearer(onlyBody(), origin, direction, tMin, hit);
}

// True if anything lies in (tMin, tMax).
bool traceAny(vec3 origin, vec3 direction, float tMin, float tMax) {
    TraceHit hit = TraceHit(kNoTriangle, tMax, vec2(0.0));
    TraceWalk walk = beginWalk(onlyBody(), origin, direction, tMin);
    while (walk.at < walk.end && hit.triangle == kNoTriangle) {
        uint leaf = nextLeaf(walk, tMax);
        hitLeaf(walk, leaf, hit);
    }
    return hit.triangle != kNoTriangle;
}
