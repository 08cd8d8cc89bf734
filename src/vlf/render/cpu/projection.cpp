#include "vlf/render/cpu/projection.h"

#include <algorithm>
#include <utility>

namespace vlf {

namespace {

constexpr float kMargin = 4;  ///< pixels around the picture from which a thick line still shows

/// Cuts [t0, t1] down to where (1 - t) a + t b >= 0; false if nothing is left.
bool clip(float a, float b, float& t0, float& t1) {
    if (a < 0 && b < 0) return false;
    if (a < 0) t0 = std::max(t0, a / (a - b));
    if (b < 0) t1 = std::min(t1, a / (a - b));
    return t0 <= t1;
}

}  // namespace

Projection::Projection(const Camera& camera, int width, int height)
    : eye_(camera.eye), size_(width, height) {
    forward_ = glm::normalize(camera.look - camera.eye);
    right_ = glm::normalize(glm::cross(forward_, glm::normalize(camera.up)));
    down_ = glm::cross(forward_, right_);
    focalLength_ = 0.5f * height / std::tan(0.5f * camera.verticalFov * (kPi / 180));
    shift_ = {camera.shift.x, -camera.shift.y};
}

Vec3 Projection::toView(const Vec3& p) const {
    const Vec3 d = p - eye_;
    const float depth = glm::dot(forward_, d);
    return {glm::dot(right_, d) - depth * shift_.x, glm::dot(down_, d) - depth * shift_.y, depth};
}

PicturePoint Projection::fromView(const Vec3& v) const {
    return {0.5f * size_ + focalLength_ / v.z * Vec2(v), v.z};
}

std::optional<PicturePoint> Projection::project(const Vec3& p) const {
    const Vec3 v = toView(p);
    if (!(v.z > 0)) return std::nullopt;
    return fromView(v);
}

std::optional<PictureSegment> Projection::project(const Vec3& a, const Vec3& b) const {
    const Vec3 va = toView(a), vb = toView(b);
    const Vec2 slope = (0.5f * size_ + kMargin) / focalLength_;
    const float nearest = 1e-4f * std::max(std::abs(va.z), std::abs(vb.z));
    float t0 = 0, t1 = 1;
    if (!clip(va.z - nearest, vb.z - nearest, t0, t1)) return std::nullopt;
    for (int axis = 0; axis < 2; ++axis)
        for (const float side : {-1.0f, 1.0f})
            if (!clip(slope[axis] * va.z + side * va[axis], slope[axis] * vb.z + side * vb[axis],
                      t0, t1))
                return std::nullopt;
    const Vec3 from = glm::mix(va, vb, t0), to = glm::mix(va, vb, t1);
    if (!(from.z > 0 && to.z > 0)) return std::nullopt;
    return PictureSegment{fromView(from), fromView(to)};
}

Vec3 Projection::unproject(const Vec2& position, float depth) const {
    const Vec2 v = depth / focalLength_ * (position - 0.5f * size_) + depth * shift_;
    return eye_ + v.x * right_ + v.y * down_ + depth * forward_;
}

}  // namespace vlf
