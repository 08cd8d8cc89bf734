#pragma once
// Where a rigid body is: turned, scaled and moved.

#include "vlf/math/vector.h"

#include <glm/gtc/quaternion.hpp>

namespace vlf {

using Quat = glm::quat;

/// From the body's own space to the world: x -> scale * rotation * x + translation. `rotation` is a
/// unit quaternion, `scale` > 0, `translation` in metres.
struct Pose {
    Vec3 translation{0};
    Quat rotation{1, 0, 0, 0};
    float scale = 1;

    Vec3 point(const Vec3& p) const { return translation + scale * (rotation * p); }
    /// Directions and normals keep their length.
    Vec3 direction(const Vec3& d) const { return rotation * d; }

    Vec3 inversePoint(const Vec3& p) const {
        return (glm::conjugate(rotation) * (p - translation)) / scale;
    }
    Vec3 inverseDirection(const Vec3& d) const { return glm::conjugate(rotation) * d; }

    Mat4 matrix() const {
        Mat4 m = glm::mat4_cast(rotation);
        for (int column = 0; column < 3; ++column) m[column] *= scale;
        m[3] = Vec4(translation, 1);
        return m;
    }

    friend bool operator==(const Pose&, const Pose&) = default;
};

inline bool isValid(const Pose& pose) {
    const float length = glm::length(pose.rotation);
    return isFinite(pose.translation) && std::isfinite(pose.scale) && pose.scale > 0 &&
           std::abs(length - 1) < 1e-3f;
}

}  // namespace vlf
