// Light transport: read this first.
//
// Irradiance E at a texel is what emitters send it directly plus what it gathers from the others.
// Every ray of a bundle that hits a texel is a cosine-distributed sample of its hemisphere, so
//
//     E = E_direct + π · (Σ L seen) / (number of samples),      L = ρ E / π
//
// a ratio: no cell areas and no solid angles, and a white furnace is exact. One sweep over a set of
// directions is one bounce of all light (a Jacobi iteration). Coarse sweeps, each in a new random
// rotation, bring the light to rest; a fine one then gives every texel its value.

#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/convergence.h"
#include "vlf/propagate/ray_gather.h"
#include "vlf/propagate/smooth_indirect.h"

#include <algorithm>

namespace vlf {

namespace {

/// Directions are dealt to this many accumulators, added up in order: the sum is the same for any
/// number of threads.
constexpr std::size_t kAccumulators = 8;

constexpr int kMinSamples = 64;
constexpr std::size_t kTexelsPerBlock = 256;

bool isBlack(const Material& material) {
    return maxComponent(material.diffuse) <= 0;
}

/// L = ρ E / π for every texel. Buried and divided ones, whose E is not known, are no samples
/// unless they are black.
TexelBuffer emit(const BakeState& state) {
    TexelBuffer radiance(state.unwrap.atlasSize());
    const auto& texels = state.unwrap.texels;
    for (std::size_t i = 0; i < texels.size(); ++i)
        radiance.set(texels[i], state.reflectance[i] * state.irradiance[i] / kPi, 1);
    for (const auto* excluded : {&state.unwrap.buried, &state.unwrap.divided})
        for (const auto& [texel, chart] : *excluded)
            if (isBlack(state.scene.materials[state.unwrap.charts[chart].material]))
                radiance.set(texel, Vec3(0), 1);
    for (const auto& [texel, proxy] : state.unwrap.proxies)
        radiance.set(texel, radiance.rgb(proxy), 1);
    radiance.set(radiance.texelCount(), Vec3(0), 1);  // outside: black
    return radiance;
}

/// Sweeps every bundle and gathers what the texels see, in the kAccumulators parts of the state.
void sweep(BakeState& state, const DirectionSet& directions, int cells, int rotation,
           const TexelBuffer& radiance, Progress& progress) {
    std::vector<TexelBuffer>& gathered = state.parts;
    gathered.resize(kAccumulators);
    std::vector<std::uint64_t> exchanges(kAccumulators, 0);
    const std::uint64_t seed =
        mixBits(state.params.seed) + static_cast<std::uint64_t>(rotation + 1);
    RandomStream turns(seed, ~0ull);
    const Mat3 turn =
        rotation < 0 ? Mat3(1) : sampleUniformRotation(Vec3(turns.next2(), turns.next()));
    const auto lines = static_cast<std::size_t>(directions.lineCount());
    ProgressCounter done(progress, lines);
    parallelFor(kAccumulators, [&](std::size_t a) {
        gathered[a].reset(state.unwrap.atlasSize());
        SweepScratch scratch;
        RayGatherer mirrors(state.scene, state.rays, state.unwrap, state.sources);
        std::vector<MirrorSight> sights;
        BentSums bent(state.bentTexels);
        for (std::size_t line = a; line < lines; line += kAccumulators) {
            RandomStream random(seed, line);
            const Vec3 direction = turn * directions.direction(static_cast<std::uint32_t>(line));
            const float roll = 2 * kPi * random.next();
            const ParallelSubfield subfield =
                makeSubfield(state.frame, direction, cells, roll, random.next2());
            sights.clear();
            exchanges[a] +=
                sweepBundle(state.faces, subfield, radiance, gathered[a], sights, scratch);
            mirrors.gatherFromMirrors(subfield, sights, radiance, gathered[a]);
            bent.take(direction, gathered[a]);
            done.step();
        }
        bent.putBack(gathered[a]);
    });
    for (const std::uint64_t n : exchanges) state.report.exchanges += n;
}

/// Texels that fewer rays of the bundles met, small ones and those at the ends of charts, gather
/// the rest by rays of their own.
void topUp(const BakeState& state, const TexelBuffer& radiance, TexelBuffer& gathered) {
    const std::vector<std::uint32_t>& texels = state.unwrap.texels;
    const std::size_t blocks = (texels.size() + kTexelsPerBlock - 1) / kTexelsPerBlock;
    parallelFor(blocks, [&](std::size_t block) {
        RayGatherer gatherer(state.scene, state.rays, state.unwrap, state.sources);
        const std::size_t end = std::min(texels.size(), (block + 1) * kTexelsPerBlock);
        for (std::size_t i = block * kTexelsPerBlock; i < end; ++i) {
            const int missing = kMinSamples - static_cast<int>(gathered.weight(texels[i]));
            if (missing <= 0) continue;
            RandomStream random(mixBits(state.params.seed), texels[i]);
            gatherer.gatherFromTexel(i, missing, random, radiance, gathered);
        }
    });
}

/// E = E_direct + π ΣL / n. Texels no ray met keep what they had.
void deposit(BakeState& state, const TexelBuffer& gathered) {
    const auto& texels = state.unwrap.texels;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const float samples = gathered.weight(texels[i]);
        if (samples <= 0) continue;
        state.reached[i] = 1;
        state.irradiance[i] = state.directIrradiance[i] + kPi * gathered.rgb(texels[i]) / samples;
    }
}

}  // namespace

void propagateOnce(BakeState& state, int directions, int cells, int rotation, Progress& progress) {
    const TexelBuffer radiance = emit(state);
    sweep(state, DirectionSet(directions), cells, rotation, radiance, progress);
    TexelBuffer gathered = sumInOrder(state.parts);
    if (rotation < 0) {
        topUp(state, radiance, gathered);
        smoothIndirect(state.unwrap, state.parts, gathered);
    }
    deposit(state, gathered);
    ++state.report.sweeps;
}

namespace {

/// Takes the mean over sweeps after as many more that only bring what is still missing. The noise
/// of each is slight, but alike over whole charts, and the last sweep would hand it on.
void settle(BakeState& state, Progress& progress) {
    const BakeParams& p = state.params;
    std::vector<Vec3> sum(state.irradiance.size(), Vec3(0));
    for (int i = 0; i < 2 * p.settlingSweeps; ++i) {
        propagateOnce(state, p.coarseDirections, p.coarseCells, state.report.sweeps, progress);
        if (i < p.settlingSweeps) continue;
        for (std::size_t t = 0; t < sum.size(); ++t) sum[t] += state.irradiance[t];
    }
    for (std::size_t t = 0; t < sum.size(); ++t)
        state.irradiance[t] = sum[t] / static_cast<float>(p.settlingSweeps);
}

}  // namespace

void propagate(BakeState& state, Progress& progress, const BakeObserver& observe) {
    const BakeParams& p = state.params;
    Convergence convergence(state);
    while (!convergence.reached(p.maxBounces, p.tolerance)) {
        propagateOnce(state, p.coarseDirections, p.coarseCells, state.report.sweeps, progress);
        convergence.update(state);
        state.report.residual = convergence.residualAfter(0);
        observe(state, BakeStage::bounce);
    }
    const int settling = p.maxBounces == 0 ? p.settlingSweeps : 0;
    if (settling > 0) settle(state, progress);
    state.report.residual = convergence.residualAfter(settling);
    observe(state, BakeStage::settled);
    propagateOnce(state, p.directions, p.cells, -1, progress);
}

}  // namespace vlf
