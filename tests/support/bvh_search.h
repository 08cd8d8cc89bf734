#pragma once
// The closest hit in a Bvh by the very steps of render/gl/shaders/trace.glsl, on the CPU.

#include "vlf/trace/bvh.h"
#include "vlf/trace/ray_scene.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace vlf::test {

/// 1 / d without the infinities that would make 0 · ∞ of a ray in the plane of a box's side.
inline float safeReciprocal(float d) {
    return 1 / (std::abs(d) > 1e-20f ? d : std::copysign(1e-20f, d));
}

/// Whether the ray is in the box somewhere in (tMin, tMax).
inline bool entersBox(const BvhNode& box, const Ray& ray, const Vec3& reciprocal, float tMax) {
    const Vec3 a = (box.lower - ray.origin) * reciprocal;
    const Vec3 b = (box.upper - ray.origin) * reciprocal;
    const Vec3 near = glm::min(a, b), far = glm::max(a, b);
    const float enter = std::max(std::max(near.x, near.y), std::max(near.z, ray.tMin));
    const float leave = std::min(std::min(far.x, far.y), std::min(far.z, tMax));
    return enter <= leave;
}

/// Triangles reach a little over their edges (in parts of their size), so that rounding lets no ray
/// through between two of them.
inline constexpr float kOverlap = 1e-5f;

/// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 1997.
inline void hitTriangle(const BvhTriangle& triangle, const Ray& ray, Hit& hit) {
    const Vec3 p = glm::cross(ray.direction, triangle.e2);
    const float scale = 1 / glm::dot(triangle.e1, p);
    const Vec3 s = ray.origin - triangle.v0;
    const float u = glm::dot(s, p) * scale;
    const Vec3 q = glm::cross(s, triangle.e1);
    const float v = glm::dot(ray.direction, q) * scale;
    const float t = glm::dot(triangle.e2, q) * scale;
    if (std::min(u, v) >= -kOverlap && u + v <= 1 + kOverlap && t > ray.tMin && t < hit.t)
        hit = {triangle.sceneTriangle(), t, {u, v}};
}

struct SearchCost {
    int boxes = 0, triangles = 0;
};

/// Closest hit in (tMin, tMax), and what it took.
inline Hit closest(const Bvh& bvh, const Ray& ray, SearchCost* cost = nullptr) {
    SearchCost ignored;
    SearchCost& spent = cost ? *cost : ignored;
    const Vec3 reciprocal(safeReciprocal(ray.direction.x), safeReciprocal(ray.direction.y),
                          safeReciprocal(ray.direction.z));
    Hit hit;
    hit.t = ray.tMax;
    for (std::uint32_t at = 0; at < bvh.nodes.size();) {
        const BvhNode& node = bvh.nodes[at];
        ++spent.boxes;
        const bool entered = entersBox(node, ray, reciprocal, hit.t);
        at = entered && node.count() == 0 ? at + 1 : node.next();
        for (std::uint32_t i = 0; entered && i < node.count(); ++i, ++spent.triangles)
            hitTriangle(bvh.triangles[node.first() + i], ray, hit);
    }
    return hit ? hit : Hit{};
}

}  // namespace vlf::test
