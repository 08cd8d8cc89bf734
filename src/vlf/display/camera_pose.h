#pragma once
// Where a walker stands and looks: what navigation moves, paths record and windows remember.

#include "vlf/scene/scene.h"

namespace vlf {

/// A level head: it looks around and up and down but never tilts to a side.
struct CameraPose {
    static constexpr float kMostPitch = 1.55f;  ///< radians, just below straight up

    Vec3 eye{0};             ///< metres
    float yaw = 0;           ///< radians; 0 looks along -Z, positive turns to the left
    float pitch = 0;         ///< radians in [-kMostPitch, kMostPitch]; positive looks up
    float verticalFov = 50;  ///< degrees in (0, 180)

    bool operator==(const CameraPose&) const = default;

    Vec3 forward() const;  ///< unit
    Vec3 right() const;    ///< unit, level
};

/// A camera's pose; what it is tilted by is lost, its pitch clamped.
CameraPose poseOf(const Camera& camera);

/// The camera of a pose, which has no name.
Camera cameraOf(const CameraPose& pose);

}  // namespace vlf
