#pragma once
// A camera that is flown: it looks where the mouse turns it and goes where keys send it.

#include "vlf/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace vlf::app {

class FlyCamera {
  public:
    explicit FlyCamera(const Camera& camera) : eye_(camera.eye), fov_(camera.verticalFov) {
        const Vec3 forward = glm::normalize(camera.look - camera.eye);
        yaw_ = std::atan2(-forward.x, -forward.z);
        pitch_ = std::clamp(std::asin(std::clamp(forward.y, -1.0f, 1.0f)), -kMostPitch, kMostPitch);
    }

    /// Radians to the right and up.
    void turn(float right, float up) {
        yaw_ -= right;
        pitch_ = std::clamp(pitch_ + up, -kMostPitch, kMostPitch);
    }

    /// Metres to the right, up and forward, as the camera sees it.
    void move(const Vec3& way) {
        eye_ += way.x * Vec3(std::cos(yaw_), 0, -std::sin(yaw_)) + way.y * Vec3(0, 1, 0) +
                way.z * forward();
    }

    Camera camera() const { return {"view", eye_, eye_ + forward(), {0, 1, 0}, fov_}; }

  private:
    static constexpr float kMostPitch = 1.55f;  ///< just below straight up

    Vec3 forward() const {
        return {-std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_),
                -std::cos(yaw_) * std::cos(pitch_)};
    }

    Vec3 eye_;
    float yaw_ = 0, pitch_ = 0;  ///< radians; yaw 0 looks along -Z
    float fov_;
};

}  // namespace vlf::app
