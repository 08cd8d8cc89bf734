#include "vlf/propagate/direct_light.h"

#include "vlf/base/parallel.h"
#include "vlf/propagate/direct_refinement.h"
#include "vlf/propagate/light_gatherer.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr std::size_t kTexelsPerBlock = 64;

/// Runs `visit(gatherer, texel)` for every texel, each thread with a gatherer of its own.
template <class Visit>
void forEachTexel(std::size_t texels, const LightGatherer& prototype, ProgressCounter& done,
                  Visit visit) {
    parallelFor((texels + kTexelsPerBlock - 1) / kTexelsPerBlock, 4, [&](std::size_t block) {
        LightGatherer gatherer = prototype;
        const std::size_t end = std::min(texels, (block + 1) * kTexelsPerBlock);
        for (std::size_t i = block * kTexelsPerBlock; i < end; ++i) visit(gatherer, i);
        done.step();
    });
}

}  // namespace

std::vector<Vec3> directIrradiance(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                                   const LightSources& sources, const DirectLightParams& params,
                                   Progress& progress) {
    const std::size_t texels = unwrap.texels.size();
    std::vector<Vec3> irradiance(texels, Vec3(0));
    if (sources.images.empty()) return irradiance;
    const LightGatherer prototype(scene, rays, unwrap, sources, params.seed);
    const std::size_t blocks = (texels + kTexelsPerBlock - 1) / kTexelsPerBlock;
    ProgressCounter done(progress, (1 + kRefinementPasses) * blocks);
    std::vector<DirectEstimate> estimates(texels);
    forEachTexel(texels, prototype, done, [&](LightGatherer& gatherer, std::size_t i) {
        estimates[i] = gatherer.irradiance(texelReceiver(scene, unwrap, i), params.samples, 0);
    });
    for (int pass = 0; pass < kRefinementPasses; ++pass) {
        const std::vector<DirectEstimate> before = estimates;
        const DirectRefinement refinement(unwrap, before, params.samples, pass);
        forEachTexel(texels, prototype, done, [&](LightGatherer& gatherer, std::size_t i) {
            if (const int more = refinement.samplesToAdd(i); more > 0)
                estimates[i].merge(
                    gatherer.irradiance(texelReceiver(scene, unwrap, i), more, 1 + pass));
        });
    }
    for (std::size_t i = 0; i < texels; ++i) irradiance[i] = estimates[i].value;
    return irradiance;
}

}  // namespace vlf
