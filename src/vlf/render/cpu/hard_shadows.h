#pragma once
// Shadows that objects with ShadowKind::hard cast on the room from one point light, laid over the
// finished picture: the truth for shadow maps.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/render/cpu/surface.h"

#include <vector>

namespace vlf {

/// Refers to what it is given, which must not change while it lives. Safe to use from several
/// threads.
class HardShadows {
  public:
    /// `objects` may be null: no shadows.
    HardShadows(const DynamicRoom* objects, const RayScene& rays);

    /// The part, in [0, 1], of a room surface's radiance that shadows leave: less than one where
    /// the surface faces the light, an object lies between them, and no other surface of the room
    /// does. Lamps do not count as such: the light stands for them.
    float remaining(const Surface& surface) const;

  private:
    struct Caster {
        const LitObject* object;
        float opacity;
    };

    float opacityTowardsLight(const Ray& ray) const;
    bool reachesLight(Ray ray) const;

    const RayScene& rays_;
    const Scene* scene_ = nullptr;
    const PointLight* light_ = nullptr;
    std::vector<Caster> casters_;
};

}  // namespace vlf
