#pragma once
// How a surface scatters the light of a path: the diffuse lobe, that of a rough mirror, and the
// one direction of a perfect mirror, which no density describes.

#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/render/cpu/surface.h"

#include <limits>
#include <optional>

namespace vlf {

/// Density of a direction that only one technique can draw.
inline constexpr float kCertain = std::numeric_limits<float>::infinity();

/// Scattering at a surface towards a unit direction. Refers to the surface.
class Scattering {
  public:
    Scattering(const Surface& surface, const Vec3& toEye);

    /// Whether there is anything but the direction of a perfect mirror.
    bool hasLobes() const { return diffuseChance_ > 0 || !surface_.isPerfectMirror(); }

    /// BRDF times cosine of unit `direction`, of the lobes, sr⁻¹.
    Vec3 lobes(const Vec3& direction) const;

    /// Density with which sample() draws it by one of the lobes, per steradian.
    float density(const Vec3& direction) const;

    /// Reflected by a facet of the rough mirror that is seen from the eye, a function of a point in
    /// the unit square; may lie below the surface.
    Vec3 drawGloss(const Vec2& u) const;

    struct Sample {
        Vec3 direction{0};
        Vec3 weight{0};     ///< BRDF times cosine by density
        float density = 0;  ///< of the lobes; kCertain by a perfect mirror
    };
    /// Nothing where the light ends in the surface.
    std::optional<Sample> sample(RandomStream& random) const;

  private:
    Vec3 drawDiffuse(RandomStream& random) const;

    const Surface& surface_;
    Vec3 toEye_;
    Frame gloss_;          ///< about the normal of the rough mirror
    Vec3 glossToEye_;      ///< in it
    float diffuseChance_;  ///< of the diffuse lobe rather than the mirror
};

}  // namespace vlf
