#include "vlf/propagate/direct_light.h"

#include "vlf/propagate/light_gatherer.h"

#include <algorithm>
#include <optional>

namespace vlf {

bool findDirectLight(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                     const LightSources& sources, const DirectLightParams& params,
                     DirectLight& light, Progress& progress) {
    const std::size_t texels = unwrap.texels.size();
    light.estimates.resize(texels);
    if (sources.images.empty()) return true;
    const LightGatherer prototype(scene, rays, unwrap, sources, params.seed);
    const std::size_t blocks = (texels + kDirectBlock - 1) / kDirectBlock;
    const auto pass = static_cast<std::size_t>(light.pass);
    ProgressCounter counter(progress, (1 + kRefinementPasses) * blocks,
                            pass * blocks + countDone(light.done));
    for (; light.pass <= kRefinementPasses; ++light.pass, light.done.clear()) {
        std::optional<DirectRefinement> refinement;
        if (light.pass > 0) {
            if (light.done.empty()) light.before = light.estimates;
            refinement.emplace(unwrap, light.before, params.samples, light.pass - 1);
        }
        const auto estimate = [&](LightGatherer& gatherer, std::size_t i, int samples) {
            return gatherer.irradiance(texelReceiver(scene, unwrap, i), samples,
                                       static_cast<std::uint64_t>(light.pass));
        };
        const auto visit = [&](LightGatherer& gatherer, std::size_t i) {
            if (!refinement)
                light.estimates[i] = estimate(gatherer, i, params.samples);
            else if (const int more = refinement->samplesToAdd(i); more > 0)
                light.estimates[i].merge(estimate(gatherer, i, more));
        };
        const bool complete = resumeLoop(light.done, blocks, 4, counter, [&](std::size_t block) {
            LightGatherer gatherer = prototype;
            const std::size_t end = std::min(texels, (block + 1) * kDirectBlock);
            for (std::size_t i = block * kDirectBlock; i < end; ++i) visit(gatherer, i);
        });
        if (!complete) return false;
    }
    return true;
}

}  // namespace vlf
