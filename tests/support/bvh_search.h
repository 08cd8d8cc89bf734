#pragma once
// The closest hit in a Bvh by the very steps of render/gl/shaders/trace.glsl, on the CPU.

#include "vlf/trace/bvh.h"
#include "vlf/trace/ray_scene.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace vlf::test {

/// 1 / d without the infinities that would make 0 · ∞ of a ray in the plane of a box's side.
inline float safeReciprocal(float d) {
    return 1 / (std::abs(d) > 1e-20f ? d : std::copysign(1e-20f, d));
}

/// Distance at which the ray enters the child's box; infinity if it misses it within (tMin, tMax).
inline float enterBox(const BvhChild& child, const Ray& ray, const Vec3& reciprocal, float tMax) {
    const Vec3 a = (child.lower - ray.origin) * reciprocal;
    const Vec3 b = (child.upper - ray.origin) * reciprocal;
    const Vec3 near = glm::min(a, b), far = glm::max(a, b);
    const float enter = std::max(std::max(near.x, near.y), std::max(near.z, ray.tMin));
    const float leave = std::min(std::min(far.x, far.y), std::min(far.z, tMax));
    return enter <= leave ? enter : std::numeric_limits<float>::infinity();
}

/// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 1997.
inline void hitTriangle(const BvhTriangle& triangle, const Ray& ray, Hit& hit) {
    const Vec3 p = glm::cross(ray.direction, triangle.e2);
    const float scale = 1 / glm::dot(triangle.e1, p);
    const Vec3 s = ray.origin - triangle.v0;
    const float u = glm::dot(s, p) * scale;
    const Vec3 q = glm::cross(s, triangle.e1);
    const float v = glm::dot(ray.direction, q) * scale;
    const float t = glm::dot(triangle.e2, q) * scale;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > ray.tMin && t < hit.t)
        hit = {triangle.sceneTriangle(), t, {u, v}};
}

struct SearchCost {
    int nodes = 0, triangles = 0, deepest = 0;  ///< `deepest`: references put aside at once
};

/// Closest hit in (tMin, tMax), and what it took.
inline Hit closest(const Bvh& bvh, const Ray& ray, SearchCost* cost = nullptr) {
    SearchCost ignored;
    SearchCost& spent = cost ? *cost : ignored;
    const Vec3 reciprocal(safeReciprocal(ray.direction.x), safeReciprocal(ray.direction.y),
                          safeReciprocal(ray.direction.z));
    Hit hit;
    hit.t = ray.tMax;
    std::array<BvhReference, Bvh::kMaxDepth> aside;
    int count = 0;
    BvhReference current{1u << 30};
    while (true) {
        if (!current.isLeaf()) {
            const BvhNode& node = bvh.nodes[current.index()];
            ++spent.nodes;
            const float left = enterBox(node.child[0], ray, reciprocal, hit.t);
            const float right = enterBox(node.child[1], ray, reciprocal, hit.t);
            BvhReference near = node.child[0].reference, far = node.child[1].reference;
            if (right < left) std::swap(near, far);
            if (std::isfinite(std::max(left, right))) aside[count++] = far;
            spent.deepest = std::max(spent.deepest, count);
            if (std::isfinite(std::min(left, right))) {
                current = near;
                continue;
            }
        } else {
            for (std::uint32_t i = 0; i < current.count(); ++i, ++spent.triangles)
                hitTriangle(bvh.triangles[current.index() + i], ray, hit);
        }
        if (count == 0) break;
        current = aside[--count];
    }
    return hit ? hit : Hit{};
}

}  // namespace vlf::test
