#pragma once
// Light that a surface reflects straight from lamps, found by sampling these: emitters, punctual
// lights and the bright part of the environment. What the lobes of the surface find of the same
// light by chance is weighted against it [E. Veach and L. Guibas, "Optimally combining sampling
// techniques for Monte Carlo rendering", SIGGRAPH 1995].

#include "vlf/math/random.h"
#include "vlf/render/cpu/scattering.h"
#include "vlf/render/cpu/surface.h"
#include "vlf/scene/emitter_sampler.h"
#include "vlf/scene/light_beam.h"
#include "vlf/scene/sky.h"
#include "vlf/trace/ray_instances.h"

namespace vlf {

/// One unbiased sample each, W·m⁻²·sr⁻¹. Refers to the scene and its rays, which must outlive it;
/// safe to use from several threads, each with its own random stream.
class LampLight {
  public:
    /// `objects`: what else throws shadows; null: nothing.
    LampLight(const Scene& scene, const RayScene& rays, const RayInstances* objects = nullptr);

    /// Of points, spots and directional lights, which no lobe finds.
    Vec3 punctual(const Surface& surface, const Scattering& scattering, RandomStream& random) const;

    Vec3 emitters(const Surface& surface, const Scattering& scattering, RandomStream& random) const;
    Vec3 sky(const Surface& surface, const Scattering& scattering, RandomStream& random) const;

    /// What counts of the radiance that a ray sees which a lobe drew with `density` (kCertain:
    /// all): of the emitter at `point`, after `distance` metres along unit `direction`,
    float weightOfEmitter(const SidePoint& point, const Vec3& direction, float distance,
                          float density) const;
    /// and of the environment. By the lobes all of it can be met, by its brightness what is above
    /// the mean.
    float weightOfSky(const Vec3& direction, float density) const;

    Vec3 skyRadiance(const Vec3& direction) const { return sky_.radiance(direction); }

  private:
    Vec3 beamLight(const Surface& surface, const Scattering& scattering,
                   const LightBeam& beam) const;
    Transmittance passed(const Ray& ray) const;
    Ray rayFrom(const Surface& surface, const Vec3& direction) const;

    const Scene& scene_;
    const RayScene& rays_;
    const RayInstances* objects_;
    EmitterSampler emitters_;
    Sky sky_;  ///< the bright part, which is sought by its brightness, above the mean
};

}  // namespace vlf
