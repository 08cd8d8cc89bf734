#pragma once
// The rays of a pinhole camera.

#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

namespace vlf {

/// Rays through the points of a picture of width x height square pixels, row 0 at the top.
class CameraRays {
  public:
    /// Throws InputError if the camera has no view: eye at look, up along the line of sight, field
    /// of view outside (0, 180) degrees, a number that is not finite, or a picture without pixels.
    CameraRays(const Camera& camera, int width, int height);

    /// Unit-length ray through picture point (x, y) in pixels: (0, 0) is the upper left corner of
    /// the picture, (i + 0.5, j + 0.5) the centre of pixel (i, j).
    Ray ray(float x, float y) const {
        return {eye_, glm::normalize(corner_ + x * right_ + y * down_)};
    }

  private:
    Vec3 eye_;
    Vec3 corner_;        ///< from the eye to the upper left corner of the plane at distance 1
    Vec3 right_, down_;  ///< one pixel on that plane
};

}  // namespace vlf
