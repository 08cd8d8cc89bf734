#include "vlf/propagate/direct_light.h"

#include "vlf/propagate/light_gatherer.h"

#include <algorithm>
#include <optional>

namespace vlf {

namespace {

/// What a pass needs to know of the room.
struct Room {
    const Scene& scene;
    const RayScene& rays;
    const Unwrap& unwrap;
    const LightSources& sources;
    const DirectLightParams& params;
};

std::size_t blockCount(const Unwrap& unwrap) {
    return (unwrap.texels.size() + kDirectBlock - 1) / kDirectBlock;
}

/// Adds samplesToAdd(i) samples to texel i, for those that the pass has not done. Whether it is
/// complete; else a pause is due.
template <class SamplesToAdd>
bool runPass(const Room& room, DirectLight& light, ProgressCounter& counter,
             const SamplesToAdd& samplesToAdd) {
    const LightGatherer prototype(room.scene, room.rays, room.unwrap, room.sources,
                                  room.params.seed);
    const std::size_t texels = room.unwrap.texels.size();
    return resumeLoop(light.done, blockCount(room.unwrap), 4, counter, [&](std::size_t block) {
        LightGatherer gatherer = prototype;
        const std::size_t end = std::min(texels, (block + 1) * kDirectBlock);
        for (std::size_t i = block * kDirectBlock; i < end; ++i) {
            const int samples = samplesToAdd(i);
            if (samples <= 0) continue;
            const DirectEstimate more =
                gatherer.irradiance(texelReceiver(room.scene, room.unwrap, i), samples,
                                    static_cast<std::uint64_t>(light.pass));
            if (light.pass == 0)
                light.estimates[i] = more;
            else
                light.estimates[i].merge(more);
        }
    });
}

}  // namespace

bool findDirectLight(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                     const LightSources& sources, const DirectLightParams& params,
                     DirectLight& light, Progress& progress) {
    light.estimates.resize(unwrap.texels.size());
    if (sources.images.empty()) return true;
    const Room room{scene, rays, unwrap, sources, params};
    const std::size_t blocks = blockCount(unwrap);
    const auto pass = static_cast<std::size_t>(light.pass);
    ProgressCounter counter(progress, (1 + kRefinementPasses) * blocks,
                            pass * blocks + countDone(light.done));
    for (; light.pass <= kRefinementPasses; ++light.pass, light.done.clear()) {
        std::optional<DirectRefinement> refinement;
        if (light.pass > 0) {
            if (light.done.empty()) light.before = light.estimates;
            refinement.emplace(unwrap, light.before, params.samples, light.pass - 1);
        }
        const auto samplesToAdd = [&](std::size_t i) {
            return refinement ? refinement->samplesToAdd(i) : params.samples;
        };
        if (!runPass(room, light, counter, samplesToAdd)) return false;
    }
    light.before.clear();
    return true;
}

bool refineDirectLight(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                       const LightSources& sources, const DirectLightParams& params,
                       std::span<const float> areas, double target, DirectLight& light,
                       Progress& progress) {
    if (light.done.empty()) light.before = light.estimates;
    const DirectAllocation allocation(unwrap, areas, light.before, target);
    ProgressCounter counter(progress, blockCount(unwrap), countDone(light.done));
    if (!runPass({scene, rays, unwrap, sources, params}, light, counter,
                 [&](std::size_t i) { return allocation.samplesToAdd(i); }))
        return false;
    ++light.pass;
    light.done.clear();
    light.before.clear();
    return true;
}

}  // namespace vlf
