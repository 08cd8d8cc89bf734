#pragma once
// A view: all that a renderer needs to know of a window, a wall, an eye or a still.

#include "vlf/scene/scene.h"

namespace vlf {

struct View {
    Mat4 clipFromWorld{1};
    Vec3 eye{0};
    int x = 0, y = 0, width = 0, height = 0;  ///< viewport, pixels from the lower left
    Vec2 offset{0};  ///< pixels right and down by which clipFromWorld moves the view for
                     ///< antialiasing; lines, which need none, are not moved
};

/// The view of a camera, moved by `offset` pixels (right, down) for antialiasing. The near plane
/// lies `nearest` metres before the eye, there is no far plane. Precondition: CameraRays accepts
/// the camera and the size.
View viewOf(const Camera& camera, int width, int height, float nearest,
            const Vec2& offset = Vec2(0));

}  // namespace vlf
