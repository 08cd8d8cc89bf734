#pragma once
// A body that stands on the floors of a room and is stopped by its walls.

#include "vlf/math/bounds.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <optional>
#include <vector>

namespace vlf {

/// An upright cylinder. Metres.
struct Body {
    float eyeHeight = 1.65f;   ///< over the floor
    float radius = 0.25f;      ///< no wall comes closer to the eye
    float stepHeight = 0.35f;  ///< of what is climbed without a stop
};

/// A grown person, or a smaller one of the same build where the room is lower than rooms are.
Body bodyFor(const Bounds& room);

/// Moves the body by what the rays of a room say. Scene and rays must outlive it.
class Walker {
  public:
    Walker(const Scene& scene, const RayScene& rays, const Body& body);

    const Body& body() const { return body_; }
    /// Changes the height of the eye over the floor; the feet stay.
    void setEyeHeight(float metres);

    /// The body now has its eye here, or stands on the floor beneath, if its feet would be below.
    void placeEye(const Vec3& eye);
    Vec3 eye() const;

    /// Goes `way` (level, metres) in `seconds`: along walls that are in its way, up and down steps
    /// and ramps; falls where there is no floor within a step. Beneath no floor at all nothing
    /// falls.
    void advance(const Vec3& way, float seconds);

  private:
    struct Contact {
        float push = 0;  ///< metres by which the body is to move
        Vec3 direction{0};
    };

    void step(const Vec3& way, float seconds);
    void settle(float seconds);
    void moveUnblocked(const Vec3& way);
    Contact deepestContact() const;
    std::vector<float> obstacleHeights() const;
    std::optional<float> levelBeneath(const Vec3& point) const;
    float eyeHeightBelowCeiling() const;

    const Scene& scene_;
    const RayScene& rays_;
    Body body_;
    Vec3 feet_{0};
    float fallSpeed_ = 0;  ///< metres a second
};

}  // namespace vlf
