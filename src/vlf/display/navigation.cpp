#include "vlf/display/navigation.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr float kSecondsAcross = 6;          // to fly across the room's bounding sphere
constexpr float kEyeHeightsASecond = 0.85f;  // 1.4 m/s for a grown person
constexpr float kFaster = 3;
constexpr float kSecondsToSpeed = 0.07f;  // time constant of starting and stopping
constexpr float kAtRest = 1e-3f;          // of the flying speed: slower is no movement
constexpr float kDeadZone = 0.15f;        // of a stick
constexpr float kStickTurn = 2.2f;        // radians a second

/// The stick's deflection from the edge of its dead zone on, in [0, 1]; squared for fine control.
Vec2 beyondDeadZone(const Vec2& stick) {
    const float length = glm::length(stick);
    if (length <= kDeadZone) return Vec2(0);
    const float t = std::min((length - kDeadZone) / (1 - kDeadZone), 1.0f);
    return t * t / length * stick;
}

}  // namespace

Steering& Steering::operator+=(const Steering& other) {
    go += other.go;
    turn += other.turn;
    fast = fast || other.fast;
    return *this;
}

Steering steeringOf(const Gamepad& pad, float seconds) {
    const Vec2 go = beyondDeadZone(pad.leftStick), turn = beyondDeadZone(pad.rightStick);
    Steering steering;
    steering.go = {go.x, pad.rightTrigger - pad.leftTrigger, -go.y};
    steering.turn = -kStickTurn * seconds * turn;
    steering.fast = pad.fast;
    return steering;
}

Navigator::Navigator(const Scene& scene, const RayScene& rays, const CameraPose& start)
    : pose_(start),
      walker_(scene, rays, bodyFor(boundsOf(scene))),
      flySpeed_(2 * boundingSphere(scene).radius / kSecondsAcross) {}

Vec3 Navigator::wantedVelocity(const Steering& steering) const {
    Vec3 go = steering.go;
    const bool walking = movement_ == Movement::walk;
    if (walking) go.y = 0;
    go /= std::max(1.0f, glm::length(go));
    const Vec3 forward =
        walking ? Vec3(-std::sin(pose_.yaw), 0, -std::cos(pose_.yaw)) : pose_.forward();
    const float speed = walking ? kEyeHeightsASecond * walker_.body().eyeHeight : flySpeed_;
    return speed * speedFactor_ * (steering.fast ? kFaster : 1.0f) *
           (go.x * pose_.right() + Vec3(0, go.y, 0) + go.z * forward);
}

void Navigator::advance(const Steering& steering, float seconds) {
    pose_.yaw = std::remainder(pose_.yaw + steering.turn.x, 2 * kPi);
    pose_.pitch =
        std::clamp(pose_.pitch + steering.turn.y, -CameraPose::kMostPitch, CameraPose::kMostPitch);
    // The velocity approaches the wanted one exponentially; its integral is exact for any time.
    const Vec3 wanted = wantedVelocity(steering), lacking = velocity_ - wanted;
    const float left = std::exp(-seconds / kSecondsToSpeed);
    const Vec3 way = seconds * wanted + kSecondsToSpeed * (1 - left) * lacking;
    velocity_ = wanted + left * lacking;
    if (wanted == Vec3(0) && glm::length(velocity_) < kAtRest * flySpeed_) velocity_ = Vec3(0);
    if (movement_ == Movement::fly) {
        pose_.eye += way;
        return;
    }
    walker_.advance(way, seconds);
    pose_.eye = walker_.eye();
}

void Navigator::setPose(const CameraPose& pose) {
    pose_ = pose;
    velocity_ = Vec3(0);
    if (movement_ == Movement::walk) {
        walker_.placeEye(pose.eye);
        pose_.eye = walker_.eye();
    }
}

void Navigator::setVerticalFov(float degrees) {
    pose_.verticalFov = std::clamp(degrees, kLeastFov, kMostFov);
}

void Navigator::setMovement(Movement movement) {
    movement_ = movement;
    setPose(pose_);
}

void Navigator::setSpeedFactor(float factor) {
    speedFactor_ = std::clamp(factor, kLeastSpeed, kMostSpeed);
}

void Navigator::setEyeHeight(float metres) {
    walker_.setEyeHeight(metres);
}

}  // namespace vlf
