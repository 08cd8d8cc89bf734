#include "vlf/render/gl/view.h"

namespace vlf {

View viewOf(const Camera& camera, int width, int height, float nearest, const Vec2& offset) {
    const Vec3 forward = glm::normalize(camera.look - camera.eye);
    const Vec3 right = glm::normalize(glm::cross(forward, glm::normalize(camera.up)));
    const Vec3 up = glm::cross(right, forward);
    const float f = 1 / std::tan(0.5f * camera.verticalFov * (kPi / 180));
    const Vec2 shift(-2 * offset.x / width, 2 * offset.y / height);
    const Vec3 rows[3] = {f * height / width * right + shift.x * forward,
                          f * up + shift.y * forward, forward};
    View view;
    view.eye = camera.eye;
    view.width = width;
    view.height = height;
    view.offset = offset;
    for (int axis = 0; axis < 3; ++axis)
        view.clipFromWorld[axis] = {rows[0][axis], rows[1][axis], forward[axis], forward[axis]};
    view.clipFromWorld[3] = {-glm::dot(rows[0], camera.eye), -glm::dot(rows[1], camera.eye),
                             -glm::dot(forward, camera.eye) - 2 * nearest,
                             -glm::dot(forward, camera.eye)};
    return view;
}

}  // namespace vlf
