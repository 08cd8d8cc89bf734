#include "vlf/propagate/direct_light.h"

#include "vlf/propagate/light_gatherer.h"

#include <algorithm>
#include <optional>

namespace vlf {

namespace {

constexpr std::size_t kNeighbours = 8;  // texels, for which lights are weighed together

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

/// Texels from the i-th on that follow one another in a row of a flat chart, few of them.
std::vector<LightReceiver> neighboursFrom(const Room& room, std::size_t i, std::size_t end) {
    const Unwrap& u = room.unwrap;
    std::vector<LightReceiver> receivers;
    for (std::size_t k = i; k < std::min(end, i + kNeighbours); ++k) {
        const bool adjoins =
            u.texelChart[k] == u.texelChart[i] && u.texels[k] == u.texels[i] + (k - i);
        if (k > i && (!adjoins || !u.charts[u.texelChart[i]].planar)) break;
        receivers.push_back(texelReceiver(room.scene, u, k));
    }
    return receivers;
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
        std::vector<LightReceiver> receivers;
        const std::size_t end = std::min(texels, (block + 1) * kDirectBlock);
        for (std::size_t i = block * kDirectBlock; i < end; i += receivers.size()) {
            receivers = neighboursFrom(room, i, end);
            gatherer.weighTogether(receivers);
            for (std::size_t k = 0; k < receivers.size(); ++k) {
                const int samples = samplesToAdd(i + k);
                if (samples <= 0) continue;
                const DirectEstimate more = gatherer.irradiance(
                    receivers[k], samples, static_cast<std::uint64_t>(light.pass));
                if (light.pass == 0)
                    light.estimates[i + k] = more;
                else
                    light.estimates[i + k].merge(more);
            }
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
