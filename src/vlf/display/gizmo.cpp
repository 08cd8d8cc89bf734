#include "vlf/display/gizmo.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vlf {

namespace {

constexpr float kReach = 8;        // pixels from a line that still take hold of it
constexpr float kBehind = 2;       // pixels by which rings count as farther than arms
constexpr float kArmFrom = 0.15f;  // where an arm begins, in arms
constexpr float kGrazing = 0.05f;  // sine of an angle below which lines count as parallel
constexpr float kNowhere = std::numeric_limits<float>::infinity();

float distanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const float length2 = glm::dot(along, along);
    const float t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0;
    return glm::length(p - a - t * along);
}

}  // namespace

Screen::Screen(const Camera& camera, const Vec2& size)
    : eye_(camera.eye),
      forward_(glm::normalize(camera.look - camera.eye)),
      size_(size),
      focal_(0.5f * size.y / std::tan(0.5f * camera.verticalFov * (kPi / 180))) {
    right_ = glm::normalize(glm::cross(forward_, camera.up));
    up_ = glm::cross(right_, forward_);
}

std::optional<Vec2> Screen::point(const Vec3& world) const {
    const Vec3 way = world - eye_;
    const float depth = glm::dot(way, forward_);
    if (!(depth > 0)) return {};
    return 0.5f * size_ + focal_ / depth * Vec2(glm::dot(way, right_), -glm::dot(way, up_));
}

Ray Screen::ray(const Vec2& point) const {
    const Vec2 across = (point - 0.5f * size_) / focal_;
    return {eye_, glm::normalize(forward_ + across.x * right_ - across.y * up_)};
}

float Screen::pixelsPerMetre(const Vec3& world) const {
    const float depth = glm::dot(world - eye_, forward_);
    return depth > 0 ? focal_ / depth : 0;
}

Gizmo::Gizmo(const Screen& screen, const Pose& pose, float scale)
    : screen_(screen), pose_(pose), scale_(scale) {
    const float pixels = screen.pixelsPerMetre(pose.translation);
    if (pixels > 0) arm_ = scale * kArm / pixels;
}

Vec3 Gizmo::axis(int i) const {
    Vec3 unit(0);
    unit[i] = 1;
    return pose_.direction(unit);
}

Vec3 Gizmo::armEnd(int i) const {
    return centre() + arm_ * axis(i);
}

std::array<Vec3, 4> Gizmo::plane(int i) const {
    const Vec3 a = arm_ * axis((i + 1) % 3), b = arm_ * axis((i + 2) % 3);
    return {centre() + kPlaneFrom * (a + b), centre() + kPlaneTo * a + kPlaneFrom * b,
            centre() + kPlaneTo * (a + b), centre() + kPlaneFrom * a + kPlaneTo * b};
}

Vec3 Gizmo::ringPoint(int i, int point) const {
    const float angle = 2 * kPi * static_cast<float>(point % kRingPoints) / kRingPoints;
    return centre() +
           kRing * arm_ *
               (std::cos(angle) * axis((i + 1) % 3) + std::sin(angle) * axis((i + 2) % 3));
}

float Gizmo::distanceToLine(const Vec3& a, const Vec3& b, const Vec2& pointer) const {
    const auto p = screen_.point(a), q = screen_.point(b);
    return p && q ? distanceToSegment(pointer, *p, *q) : kNowhere;
}

float Gizmo::distanceToRing(int i, const Vec2& pointer) const {
    float least = kNowhere;
    for (int k = 0; k < kRingPoints; ++k)
        least = std::min(least, distanceToLine(ringPoint(i, k), ringPoint(i, k + 1), pointer));
    return least;
}

bool Gizmo::overPlane(int i, const Vec2& pointer) const {
    const auto hit = onPlane(i, pointer);
    if (!hit) return false;
    const Vec3 from = (*hit - centre()) / arm_;
    const auto within = [&](int k) {
        const float along = glm::dot(from, axis(k % 3));
        return along >= kPlaneFrom && along <= kPlaneTo;
    };
    return within(i + 1) && within(i + 2);
}

GizmoHandle Gizmo::pick(const Vec2& pointer) const {
    if (!shown()) return {};
    for (int i = 0; i < 3; ++i)
        if (overPlane(i, pointer)) return {GizmoPart::plane, i};
    GizmoHandle nearest;
    float least = scale_ * kReach;
    const auto offer = [&](float distance, GizmoPart part, int i) {
        if (distance < least) least = distance, nearest = {part, i};
    };
    for (int i = 0; i < 3; ++i)
        if (alongArm(i, pointer))
            offer(distanceToLine(centre() + kArmFrom * arm_ * axis(i), armEnd(i), pointer),
                  GizmoPart::arm, i);
    for (int i = 0; i < 3; ++i)
        if (onPlane(i, pointer)) offer(distanceToRing(i, pointer) + kBehind, GizmoPart::ring, i);
    return nearest;
}

/// Where the axis comes closest to the ray through the pointer, metres from the centre.
std::optional<float> Gizmo::alongArm(int i, const Vec2& pointer) const {
    const Ray ray = screen_.ray(pointer);
    const Vec3 a = axis(i), between = centre() - ray.origin;
    const float cosine = glm::dot(a, ray.direction), sine2 = 1 - cosine * cosine;
    if (sine2 < kGrazing * kGrazing) return {};
    return (cosine * glm::dot(between, ray.direction) - glm::dot(between, a)) / sine2;
}

std::optional<Vec3> Gizmo::onPlane(int i, const Vec2& pointer) const {
    const Ray ray = screen_.ray(pointer);
    const float cosine = glm::dot(axis(i), ray.direction);
    if (std::abs(cosine) < kGrazing) return {};
    const float t = glm::dot(axis(i), centre() - ray.origin) / cosine;
    if (!(t > 0)) return {};
    return ray.origin + t * ray.direction;
}

Pose Gizmo::dragged(const GizmoHandle& handle, const Vec2& from, const Vec2& to) const {
    Pose pose = pose_;
    if (handle.part == GizmoPart::arm) {
        const auto a = alongArm(handle.axis, from), b = alongArm(handle.axis, to);
        if (a && b) pose.translation += (*b - *a) * axis(handle.axis);
        return pose;
    }
    const auto a = onPlane(handle.axis, from), b = onPlane(handle.axis, to);
    if (!a || !b) return pose;
    if (handle.part == GizmoPart::plane) pose.translation += *b - *a;
    if (handle.part == GizmoPart::ring) {
        const Vec3 before = *a - centre(), after = *b - centre();
        const float angle = std::atan2(glm::dot(axis(handle.axis), glm::cross(before, after)),
                                       glm::dot(before, after));
        pose.rotation = glm::normalize(glm::angleAxis(angle, axis(handle.axis)) * pose.rotation);
    }
    return pose;
}

}  // namespace vlf
