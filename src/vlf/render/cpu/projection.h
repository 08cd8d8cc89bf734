#pragma once
// From the world to the picture: the inverse of CameraRays.

#include "vlf/scene/scene.h"

#include <optional>

namespace vlf {

/// A point in the picture, in pixels as CameraRays counts them, and its distance in metres along
/// the line of sight.
struct PicturePoint {
    Vec2 position{0};
    float depth = 0;
};

/// A straight line in the picture and where its points lie in the world.
struct PictureSegment {
    PicturePoint from, to;

    float length() const { return glm::distance(from.position, to.position); }  ///< pixels
    /// At fraction s of the way in the picture.
    Vec2 at(float s) const { return glm::mix(from.position, to.position, s); }
    float depthAt(float s) const { return 1 / glm::mix(1 / from.depth, 1 / to.depth, s); }
};

class Projection {
  public:
    /// Precondition: CameraRays accepts the camera and the size.
    Projection(const Camera& camera, int width, int height);

    const Vec3& eye() const { return eye_; }

    /// Nothing if the point is not in front of the camera.
    std::optional<PicturePoint> project(const Vec3& p) const;

    /// The part of a segment that lies within the picture; nothing if there is none.
    std::optional<PictureSegment> project(const Vec3& a, const Vec3& b) const;

    /// The world point seen at a picture position at a depth.
    Vec3 unproject(const Vec2& position, float depth) const;

  private:
    /// Metres to the right of and below what the picture's centre shows at its depth, and the
    /// depth.
    Vec3 toView(const Vec3& p) const;
    PicturePoint fromView(const Vec3& v) const;

    Vec3 eye_, right_, down_, forward_;
    Vec2 size_;          ///< pixels
    float focalLength_;  ///< pixels
    Vec2 shift_;         ///< Camera::shift, counted to the right and down
};

}  // namespace vlf
