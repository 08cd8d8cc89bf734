#include "vlf/display/stereo.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vlf {

namespace {

void requireEyes(const EyePair& eyes) {
    if (!(eyes.separation >= 0 && std::isfinite(eyes.separation)))
        throw InputError("the eyes' separation must be a number of metres, 0 or more");
    if (eyes.convergence && !(*eyes.convergence > 0 && std::isfinite(*eyes.convergence)))
        throw InputError("the distance of convergence must be a number of metres above 0");
}

}  // namespace

Camera cameraOf(Eye eye, const Camera& camera, const EyePair& eyes) {
    requireEyes(eyes);
    const Vec3 across = glm::cross(camera.look - camera.eye, camera.up);
    if (!(glm::length(across) > 0)) return camera;  // has no view: whoever renders it says why
    const Vec3 right = glm::normalize(across);
    const float aside = (eye == Eye::left ? -0.5f : 0.5f) * eyes.separation;
    Camera result = camera;
    result.eye += aside * right;
    result.look += aside * right;
    if (eyes.convergence) result.shift.x -= aside / *eyes.convergence;
    return result;
}

float disparity(const Camera& camera, const EyePair& eyes, float depth, int height) {
    const float focalLength =
        0.5f * static_cast<float>(height) / std::tan(0.5f * camera.verticalFov * (kPi / 180));
    const float meeting = eyes.convergence ? 1 / *eyes.convergence : 0;
    return focalLength * eyes.separation * (1 / depth - meeting);
}

Image sideBySide(const Image& left, const Image& right) {
    assert(left.width == right.width && left.height == right.height);
    Image both(2 * left.width, left.height);
    for (int y = 0; y < left.height; ++y) {
        std::copy_n(&left.at(0, y), left.width, &both.at(0, y));
        std::copy_n(&right.at(0, y), right.width, &both.at(left.width, y));
    }
    return both;
}

Image anaglyph(const Image& left, const Image& right) {
    assert(left.width == right.width && left.height == right.height);
    // Rows of the paper's matrix for a CRT display and red-cyan glasses.
    constexpr float kLeft[3][3] = {{0.4561f, 0.500484f, 0.176381f},
                                   {-0.0400822f, -0.0378246f, -0.0157589f},
                                   {-0.0152161f, -0.0205971f, -0.00546856f}};
    constexpr float kRight[3][3] = {{-0.0434706f, -0.0879388f, -0.00155529f},
                                    {0.378476f, 0.73364f, -0.0184503f},
                                    {-0.0721527f, -0.112961f, 1.2264f}};
    const auto row = [](const float(&r)[3]) { return Vec3(r[0], r[1], r[2]); };
    Image both(left.width, left.height);
    for (std::size_t i = 0; i < both.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            both.pixels[i][c] = std::clamp(
                glm::dot(row(kLeft[c]), left.pixels[i]) + glm::dot(row(kRight[c]), right.pixels[i]),
                0.0f, 1.0f);
    return both;
}

}  // namespace vlf
