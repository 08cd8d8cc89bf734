#pragma once
// A view: all that a renderer needs to know of a window, a wall, an eye or a still.

#include "vlf/scene/scene.h"

#include <optional>

namespace vlf {

struct PixelRectangle {
    int x = 0, y = 0, width = 0, height = 0;  ///< pixels from the lower left

    friend bool operator==(const PixelRectangle&, const PixelRectangle&) = default;
};

struct View {
    Mat4 clipFromWorld{1};
    Vec3 eye{0};
    int x = 0, y = 0, width = 0, height = 0;  ///< viewport, pixels from the lower left
    std::optional<PixelRectangle> part;       ///< draw no more than this, within the viewport
    Vec2 offset{
        0};  ///< by which clipFromWorld is shifted; lines, antialiased by themselves, are not
};

/// The view moved by `offset` pixels (right, down), for antialiasing.
View shifted(const View& view, const Vec2& offset);

/// The view of a camera. The near plane lies `nearest` metres before the eye, there is no far
/// plane. Precondition: CameraRays accepts the camera and the size.
View viewOf(const Camera& camera, int width, int height, float nearest);

}  // namespace vlf
