#pragma once
// Shadows that objects with ShadowKind::hard cast on the room from one point light, laid over the
// finished picture: the truth for shadow maps.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/render/cpu/surface.h"

#include <utility>
#include <vector>

namespace vlf {

/// Refers to what it is given, which must not change while it lives. Safe to use from several
/// threads.
class HardShadows {
  public:
    struct Caster {
        const LitObject* object = nullptr;
        float opacity = 1;
    };

    /// `light` may be null: no shadows.
    HardShadows(const Scene& scene, const RayScene& rays, const PointLight* light,
                std::vector<Caster> casters)
        : scene_(scene), rays_(rays), light_(light), casters_(std::move(casters)) {}

    /// The part, in [0, 1], of a room surface's radiance that shadows leave: less than one where
    /// the surface faces the light, an object lies between them, and no other surface of the room
    /// does. Lamps do not count as such: the light stands for them.
    float remaining(const Surface& surface) const;

  private:
    float opacityTowardsLight(const Ray& ray) const;
    bool reachesLight(Ray ray) const;

    const Scene& scene_;
    const RayScene& rays_;
    const PointLight* light_;
    std::vector<Caster> casters_;
};

/// The lit objects with ShadowKind::hard.
std::vector<HardShadows::Caster> hardShadowCasters(const DynamicRoom& objects);

}  // namespace vlf
