#pragma once
// How a walker moves: flying through everything, or on foot.

#include "vlf/display/camera_pose.h"
#include "vlf/display/keys.h"
#include "vlf/display/walker.h"

namespace vlf {

enum class Movement {
    fly,   ///< wherever one looks, through walls too
    walk,  ///< level, on the floor, not through walls
};

/// What the walker wants for the next moment.
struct Steering {
    Vec3 go{0};         ///< right, up, forward; each in [-1, 1]; on foot there is no up
    Vec2 turn{0};       ///< radians to be turned: to the left, up
    bool fast = false;  ///< three times as fast

    Steering& operator+=(const Steering& other);
};

/// What a gamepad wants for so many seconds: the left stick goes, the right one turns, the triggers
/// go down and up. Sticks near their middle are at rest.
Steering steeringOf(const Gamepad& pad, float seconds);

/// Moves a pose through a room. The path taken does not depend on how time is cut into frames, but
/// for a small part of the body's radius on foot. Scene and rays must outlive it.
class Navigator {
  public:
    static constexpr float kLeastSpeed = 0.05f, kMostSpeed = 20;  ///< factors
    static constexpr float kLeastFov = 20, kMostFov = 120;        ///< degrees

    Navigator(const Scene& scene, const RayScene& rays, const CameraPose& start);

    void advance(const Steering& steering, float seconds);

    const CameraPose& pose() const { return pose_; }
    /// Stands still there; on foot, on the floor beneath.
    void setPose(const CameraPose& pose);
    void setVerticalFov(float degrees);  ///< clamped to [kLeastFov, kMostFov]

    Movement movement() const { return movement_; }
    void setMovement(Movement movement);

    /// Multiplies the speed, which is in flight the room's diameter in six seconds and on foot that
    /// of a person of the body's size.
    float speedFactor() const { return speedFactor_; }
    void setSpeedFactor(float factor);  ///< clamped to [kLeastSpeed, kMostSpeed]

    float eyeHeight() const { return walker_.body().eyeHeight; }  ///< on foot, metres
    void setEyeHeight(float metres);

  private:
    Vec3 wantedVelocity(const Steering& steering) const;

    CameraPose pose_;
    Movement movement_ = Movement::fly;
    Walker walker_;
    float flySpeed_;  ///< metres a second
    float speedFactor_ = 1;
    Vec3 velocity_{0};  ///< metres a second
};

}  // namespace vlf
