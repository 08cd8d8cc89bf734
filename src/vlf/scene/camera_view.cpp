#include "vlf/scene/camera_view.h"

namespace vlf {

bool hasView(const Camera& camera) {
    const Vec3 forward = glm::normalize(camera.look - camera.eye);
    const Vec3 side = glm::cross(forward, glm::normalize(camera.up));
    return isFinite(camera.eye) && glm::length(side) > 1e-5f && camera.verticalFov > 0 &&
           camera.verticalFov < 180;
}

}  // namespace vlf
