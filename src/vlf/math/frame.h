#pragma once
// Orthonormal frames.

#include "vlf/math/vector.h"

namespace vlf {

/// Right-handed orthonormal frame; `normal` is its third axis.
struct Frame {
    Vec3 tangent, bitangent, normal;

    Vec3 toWorld(const Vec3& local) const {
        return local.x * tangent + local.y * bitangent + local.z * normal;
    }
    Vec3 toLocal(const Vec3& world) const {
        return {glm::dot(world, tangent), glm::dot(world, bitangent), glm::dot(world, normal)};
    }
};

/// A frame around unit vector n, continuous but for n.z = 0 (Duff et al., "Building an
/// Orthonormal Basis, Revisited", JCGT 6(1), 2017).
inline Frame frameFromNormal(const Vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x},
            {b, sign + n.y * n.y * a, -n.y},
            n};
}

}  // namespace vlf
