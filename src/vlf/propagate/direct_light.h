#pragma once
// Direct light: irradiance at the texels from emitters, straight and by way of planar mirrors.
// Sampled apart from the bundles, which would need a hundred times the rays to find small
// emitters.

#include "vlf/base/resumable_loop.h"
#include "vlf/propagate/direct_refinement.h"
#include "vlf/propagate/light_sources.h"
#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/unwrap.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

struct DirectLightParams {
    int samples = 4;  ///< shadow rays per texel, shared among the lights by their likely effect;
                      ///< penumbrae take several times as many
    std::uint64_t seed = 0;
};

/// Texels are worked off in blocks of so many.
inline constexpr std::size_t kDirectBlock = 64;

/// Direct light, complete or under way.
struct DirectLight {
    std::vector<DirectEstimate> estimates;  ///< of unwrap.texels
    std::vector<DirectEstimate> before;  ///< those before the pass, which tell it where to refine
    std::int32_t pass = 0;  ///< the first and kRefinementPasses more, and what refines them
    LoopMarks done;         ///< blocks of the pass
};

/// Goes on until `light` is complete (true) or a pause is due (false). The estimates are unbiased
/// but for the ratio estimator's O(1/n). Throws Cancelled; then, too, it can be gone on with.
bool findDirectLight(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                     const LightSources& sources, const DirectLightParams& params,
                     DirectLight& light, Progress& progress);

/// One more pass over light that is complete, towards a square error of `target` (see
/// DirectAllocation). Likewise true once it has ended, and to be gone on with.
bool refineDirectLight(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                       const LightSources& sources, const DirectLightParams& params,
                       std::span<const float> areas, double target, DirectLight& light,
                       Progress& progress);

}  // namespace vlf
