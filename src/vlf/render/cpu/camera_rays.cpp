#include "vlf/render/cpu/camera_rays.h"

#include "vlf/base/error.h"

namespace vlf {

namespace {

void requireView(const Camera& camera, int width, int height) {
    const auto fail = [&](const char* what) {
        throw InputError("camera \"" + camera.name + "\": " + what);
    };
    if (width < 1 || height < 1) fail("the picture needs at least one pixel each way");
    if (!isFinite(camera.eye) || !isFinite(camera.look) || !isFinite(camera.up) ||
        !isFinite(Vec3(camera.shift, 0)))
        fail("eye, look, up and shift must be finite numbers");
    if (!(camera.verticalFov > 0 && camera.verticalFov < 180))
        fail("the field of view must lie between 0 and 180 degrees");
    const Vec3 forward = camera.look - camera.eye;
    if (glm::length(forward) == 0) fail("eye and look are the same point");
    if (glm::length(camera.up) == 0) fail("up has no length");
    const Vec3 side = glm::cross(glm::normalize(forward), glm::normalize(camera.up));
    if (!(glm::length(side) > 1e-5f)) fail("up points along the line of sight; choose another up");
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height) : eye_(camera.eye) {
    requireView(camera, width, height);
    const Vec3 forward = glm::normalize(camera.look - camera.eye);
    const Vec3 right = glm::normalize(glm::cross(forward, glm::normalize(camera.up)));
    const Vec3 up = glm::cross(right, forward);
    const float pixel = 2 * std::tan(0.5f * camera.verticalFov * (kPi / 180)) / height;
    right_ = pixel * right;
    down_ = -pixel * up;
    const Vec3 centre = forward + camera.shift.x * right + camera.shift.y * up;
    corner_ = centre - 0.5f * width * right_ - 0.5f * height * down_;
}

}  // namespace vlf
