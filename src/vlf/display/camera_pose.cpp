#include "vlf/display/camera_pose.h"

#include <algorithm>
#include <cmath>

namespace vlf {

Vec3 CameraPose::forward() const {
    return {-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

Vec3 CameraPose::right() const {
    return {std::cos(yaw), 0, -std::sin(yaw)};
}

CameraPose poseOf(const Camera& camera) {
    const Vec3 forward = glm::normalize(camera.look - camera.eye);
    const float pitch = std::asin(std::clamp(forward.y, -1.0f, 1.0f));
    CameraPose pose;
    pose.eye = camera.eye;
    pose.yaw = std::atan2(-forward.x, -forward.z);
    pose.pitch = std::clamp(pitch, -CameraPose::kMostPitch, CameraPose::kMostPitch);
    pose.verticalFov = camera.verticalFov;
    return pose;
}

Camera cameraOf(const CameraPose& pose) {
    return {"", pose.eye, pose.eye + pose.forward(), {0, 1, 0}, pose.verticalFov};
}

}  // namespace vlf
