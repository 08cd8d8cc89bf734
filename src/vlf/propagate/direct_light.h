#pragma once
// Direct light: irradiance at the texels from emitters, straight and by way of planar mirrors.
// Sampled apart from the bundles, which would need a hundred times the rays to find small
// emitters.

#include "vlf/base/progress.h"
#include "vlf/propagate/light_sources.h"
#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/unwrap.h"

#include <vector>

namespace vlf {

struct DirectLightParams {
    int samples = 4;  ///< shadow rays per texel, shared among the lights by their likely effect;
                      ///< penumbrae take several times as many
    std::uint64_t seed = 0;
};

/// Irradiance (W·m⁻²) at each of unwrap.texels. Unbiased but for the ratio estimator's O(1/n).
/// Throws Cancelled.
std::vector<Vec3> directIrradiance(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                                   const LightSources& sources, const DirectLightParams& params,
                                   Progress& progress);

}  // namespace vlf
