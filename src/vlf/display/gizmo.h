#pragma once
// A handle on an object in a picture: arms, planes and rings along its axes, by which a pointer
// takes hold of it. Knows neither window nor drawing.

#include "vlf/math/pose.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <array>
#include <optional>

namespace vlf {

/// The points of a camera's picture and the rays through them. Points are in pixels from the upper
/// left.
class Screen {
  public:
    /// `size`: width and height in pixels, above zero.
    Screen(const Camera& camera, const Vec2& size);

    /// None: not before the eye.
    std::optional<Vec2> point(const Vec3& world) const;
    Ray ray(const Vec2& point) const;

    /// Pixels that a metre across the line of sight takes there; 0: not before the eye.
    float pixelsPerMetre(const Vec3& world) const;

    const Vec3& eye() const { return eye_; }

  private:
    Vec3 eye_, right_, up_, forward_;
    Vec2 size_;
    float focal_;  ///< pixels
};

enum class GizmoPart { none, arm, plane, ring };

/// A part of the gizmo: along the axis, across it, or around it.
struct GizmoHandle {
    GizmoPart part = GizmoPart::none;
    int axis = 0;  ///< 0 to 2

    explicit operator bool() const { return part != GizmoPart::none; }
    friend bool operator==(const GizmoHandle&, const GizmoHandle&) = default;
};

/// The gizmo of an object in its own frame, of the same size on every screen.
class Gizmo {
  public:
    static constexpr float kArm = 90;          ///< pixels
    static constexpr float kRing = 1.15f;      ///< radius, in arms
    static constexpr float kPlaneFrom = 0.3f;  ///< the planes' squares begin here, in arms
    static constexpr float kPlaneTo = 0.55f;
    static constexpr int kRingPoints = 48;

    /// `scale`: of lengths on the screen.
    Gizmo(const Screen& screen, const Pose& pose, float scale = 1);

    /// Not before the eye: there is none.
    bool shown() const { return arm_ > 0; }

    const Vec3& centre() const { return pose_.translation; }
    Vec3 armEnd(int axis) const;
    std::array<Vec3, 4> plane(int axis) const;  ///< corners of the square across an axis
    Vec3 ringPoint(int axis, int i) const;      ///< of kRingPoints

    /// What is under the pointer, of the parts that a drag would move; the nearest within some
    /// pixels.
    GizmoHandle pick(const Vec2& pointer) const;

    /// The pose after the handle was dragged from one point to another, from the pose that the
    /// gizmo was made for. Where the drag says nothing, as along an arm that points at the eye, it
    /// stays.
    Pose dragged(const GizmoHandle& handle, const Vec2& from, const Vec2& to) const;

  private:
    Vec3 axis(int i) const;
    std::optional<float> alongArm(int axis, const Vec2& pointer) const;
    std::optional<Vec3> onPlane(int axis, const Vec2& pointer) const;
    float distanceToLine(const Vec3& a, const Vec3& b, const Vec2& pointer) const;
    float distanceToRing(int axis, const Vec2& pointer) const;
    bool overPlane(int axis, const Vec2& pointer) const;

    Screen screen_;
    Pose pose_;
    float scale_;
    float arm_ = 0;  ///< metres
};

}  // namespace vlf
