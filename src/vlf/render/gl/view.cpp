#include "vlf/render/gl/view.h"

namespace vlf {

View shifted(const View& view, const Vec2& offset) {
    View moved = view;
    moved.offset += offset;
    const Vec2 shift(-2 * offset.x / view.width, 2 * offset.y / view.height);
    for (int column = 0; column < 4; ++column) {
        Vec4& c = moved.clipFromWorld[column];
        c = Vec4(Vec2(c) + shift * c.w, c.z, c.w);
    }
    return moved;
}

View viewOf(const Camera& camera, int width, int height, float nearest) {
    const Vec3 forward = glm::normalize(camera.look - camera.eye);
    const Vec3 right = glm::normalize(glm::cross(forward, glm::normalize(camera.up)));
    const Vec3 up = glm::cross(right, forward);
    const float f = 1 / std::tan(0.5f * camera.verticalFov * (kPi / 180));
    const Vec2 scale(f * height / width, f);
    const Vec2 shift = scale * camera.shift;
    const Vec3 rows[2] = {scale.x * right - shift.x * forward, scale.y * up - shift.y * forward};
    View view;
    view.eye = camera.eye;
    view.width = width;
    view.height = height;
    for (int axis = 0; axis < 3; ++axis)
        view.clipFromWorld[axis] = {rows[0][axis], rows[1][axis], forward[axis], forward[axis]};
    view.clipFromWorld[3] = {-glm::dot(rows[0], camera.eye), -glm::dot(rows[1], camera.eye),
                             -glm::dot(forward, camera.eye) - 2 * nearest,
                             -glm::dot(forward, camera.eye)};
    return view;
}

}  // namespace vlf
