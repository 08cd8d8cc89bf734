// Light transport: read this first.
//
// Irradiance E at a texel is what emitters send it directly plus what it gathers from the others.
// Every ray of a bundle that hits a texel is a cosine-distributed sample of its hemisphere, so
//
//     E = E_direct + π · (Σ L seen) / (number of samples),      L = ρ E / π
//
// a ratio: no cell areas and no solid angles, and a white furnace is exact. One sweep over a set of
// directions is one bounce of all light (a Jacobi iteration). Coarse sweeps, each in a new random
// rotation, bring the light to rest; a fine one then gives every texel its value. A ray that leaves
// the scene sees the smooth part of the environment; its bright part is direct light (sky_light.h).
//
// How far it is lies in the state alone. The long loops end early when a pause is due, the state is
// shown to the observer, and they go on; a state that was kept then goes on the same way.

#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/convergence.h"
#include "vlf/propagate/indirect_noise.h"
#include "vlf/propagate/ray_gather.h"
#include "vlf/propagate/smooth_indirect.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace {

constexpr int kMinSamples = 64;              // of a texel after a fine sweep
constexpr double kLinesOfMinSamples = 2049;  // of several: in proportion to their lines

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
    radiance.set(radiance.texelCount(), Vec3(0), 1);  // outside: what is seen there is added
    return radiance;
}

/// Lines that the accumulators have swept.
std::size_t linesSwept(const Sweep& sweep) {
    std::size_t sum = 0;
    for (std::size_t a = 0; a < kAccumulators; ++a) sum += (sweep.nextLine[a] - a) / kAccumulators;
    return sum;
}

/// `onTop`: of what the accumulators hold.
void beginSweep(BakeState& state, bool onTop) {
    Sweep& s = state.sweep;
    s.nextLine.resize(kAccumulators);
    parallelFor(kAccumulators, [&](std::size_t a) {
        s.nextLine[a] = static_cast<std::uint32_t>(a);
        s.exchanges[a] = 0;
        if (onTop) {  // bent texels have theirs in sums of their own
            for (const BentTexel& bent : state.bentTexels) s.parts[a].set(bent.texel, Vec3(0), 0);
            return;
        }
        s.bent[a].assign(state.bentTexels.size(), {});
        s.parts[a].reset(state.unwrap.atlasSize());
    });
    s.gathered = {};
    s.toppedUp.clear();
}

/// Sweeps the bundles that are left and gathers what the texels see, in the parts of the state's
/// sweep. Whether all are done; else a pause is due.
bool sweepBundles(BakeState& state, const DirectionSet& directions, int cells, int rotation,
                  const TexelBuffer& radiance, Progress& progress) {
    Sweep& s = state.sweep;
    const std::uint64_t seed =
        mixBits(state.params.seed) + static_cast<std::uint64_t>(rotation + 1);
    RandomStream turns(seed, ~0ull);
    const Mat3 turn =
        rotation < 0 ? Mat3(1) : sampleUniformRotation(Vec3(turns.next2(), turns.next()));
    const auto lines = static_cast<std::uint32_t>(directions.lineCount());
    const std::vector<Vec3> outside = state.sources.sky
                                          ? outsideViews(*state.sources.sky, directions, turn)
                                          : std::vector<Vec3>(2 * std::size_t{lines}, Vec3(0));
    ProgressCounter done(progress, lines, linesSwept(s));
    parallelFor(kAccumulators, [&](std::size_t a) {
        SweepScratch scratch;
        RayGatherer mirrors(state.scene, state.rays, state.unwrap, state.sources);
        std::vector<MirrorSight> sights;
        BentSums bent(state.bentTexels, s.bent[a]);
        while (s.nextLine[a] < lines) {
            if (done.pauseDue()) return;
            const std::uint32_t line = s.nextLine[a];
            RandomStream random(seed, line);
            const Vec3 direction = turn * directions.direction(line);
            const float roll = 2 * kPi * random.next();
            const ParallelSubfield subfield =
                makeSubfield(state.frame, direction, cells, roll, random.next2());
            sights.clear();
            s.exchanges[a] +=
                sweepBundle(state.faces, subfield, radiance, s.parts[a], sights, scratch,
                            {outside[line], outside[directions.opposite(line)]});
            mirrors.gatherFromMirrors(subfield, sights, random, radiance, s.parts[a]);
            bent.take(direction, s.parts[a]);
            s.nextLine[a] += kAccumulators;
            done.step();
        }
        bent.putBack(s.parts[a]);
    });
    return std::all_of(s.nextLine.begin(), s.nextLine.end(),
                       [&](std::uint32_t next) { return next >= lines; });
}

/// Texels that fewer rays of the bundles met, small ones and those at the ends of charts, gather
/// the rest by rays of their own. Whether all have; else a pause is due.
bool topUp(BakeState& state, int samples, const TexelBuffer& radiance, Progress& progress) {
    TexelBuffer& gathered = state.sweep.gathered;
    LoopMarks& done = state.sweep.toppedUp;
    const std::vector<std::uint32_t>& texels = state.unwrap.texels;
    const std::size_t blocks = (texels.size() + kTopUpBlock - 1) / kTopUpBlock;
    ProgressCounter counter(progress, blocks, countDone(done));
    return resumeLoop(done, blocks, 1, counter, [&](std::size_t block) {
        RayGatherer gatherer(state.scene, state.rays, state.unwrap, state.sources);
        const std::size_t end = std::min(texels.size(), (block + 1) * kTopUpBlock);
        for (std::size_t i = block * kTopUpBlock; i < end; ++i) {
            const int missing = samples - static_cast<int>(gathered.weight(texels[i]));
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

/// Takes what was gathered.
void endSweep(BakeState& state) {
    Sweep& s = state.sweep;
    deposit(state, s.gathered);
    for (const std::uint64_t n : s.exchanges) state.report.exchanges += n;
    ++state.report.sweeps;
    s.nextLine.clear();
    s.gathered = {};
    s.toppedUp.clear();
}

}  // namespace

void propagateOnce(BakeState& state, int directions, int cells, int rotation, Progress& progress,
                   const BakeObserver& observe) {
    if (state.sweep.nextLine.empty()) beginSweep(state, false);
    const TexelBuffer radiance = emit(state);
    while (!sweepBundles(state, DirectionSet(directions), cells, rotation, radiance, progress))
        observe(state);
    Sweep& s = state.sweep;
    if (s.gathered.empty()) s.gathered = sumInOrder(s.parts);
    if (rotation < 0) {
        while (!topUp(state, kMinSamples, radiance, progress)) observe(state);
        smoothIndirect(state.unwrap, s.parts, s.gathered);
        state.indirectVariance = indirectVariance(state.unwrap, s.parts, s.gathered, false);
    }
    endSweep(state);
}

void refineOnce(BakeState& state, int directions, Progress& progress, const BakeObserver& observe) {
    Sweep& s = state.sweep;
    Refinement& r = state.refinement;
    if (s.nextLine.empty()) beginSweep(state, r.sweptLines > 0);
    const TexelBuffer radiance = emit(state);
    while (!sweepBundles(state, DirectionSet(directions), state.params.cells, state.report.sweeps,
                         radiance, progress))
        observe(state);
    if (s.gathered.empty()) s.gathered = sumInOrder(s.parts);
    const auto lines = static_cast<double>(directions), before = static_cast<double>(r.sweptLines);
    const double samples = kMinSamples * std::max(1.0, (before + lines) / kLinesOfMinSamples);
    while (!topUp(state, static_cast<int>(samples), radiance, progress)) observe(state);
    std::array<TexelBuffer, kAccumulators> smoothed = s.parts;  // those are added to later
    smoothIndirect(state.unwrap, smoothed, s.gathered);
    state.indirectVariance = indirectVariance(state.unwrap, smoothed, s.gathered, true);
    endSweep(state);
    r.sweptLines += static_cast<std::uint64_t>(directions);
}

namespace {

/// Bounces until the light still missing is below the tolerance.
void bounce(BakeState& state, Convergence& convergence, Progress& progress,
            const BakeObserver& observe) {
    const BakeParams& p = state.params;
    while (!convergence.reached(p.maxBounces, p.tolerance)) {
        propagateOnce(state, p.coarseDirections, p.coarseCells, state.report.sweeps, progress,
                      observe);
        convergence.update();
        state.report.residual = convergence.residualAfter(0);
        state.stage = BakeStage::bounce;
        observe(state);
    }
}

/// Takes the mean over sweeps after as many more that only bring what is still missing. The noise
/// of each is slight, but alike over whole charts, and the last sweep would hand it on.
void settle(BakeState& state, Progress& progress, const BakeObserver& observe) {
    const BakeParams& p = state.params;
    Settling& s = state.settling;
    s.sum.resize(state.irradiance.size(), Vec3(0));
    while (s.sweeps < 2 * p.settlingSweeps) {
        propagateOnce(state, p.coarseDirections, p.coarseCells, state.report.sweeps, progress,
                      observe);
        if (++s.sweeps <= p.settlingSweeps) continue;
        for (std::size_t t = 0; t < s.sum.size(); ++t) s.sum[t] += state.irradiance[t];
    }
    for (std::size_t t = 0; t < s.sum.size(); ++t)
        state.irradiance[t] = s.sum[t] / static_cast<float>(p.settlingSweeps);
    s = {};
}

/// Coarse bounces: everything but the last sweep.
void bringToRest(BakeState& state, Progress& progress, const BakeObserver& observe) {
    const BakeParams& p = state.params;
    Convergence convergence(state);
    bounce(state, convergence, progress, observe);
    const int settling = p.maxBounces == 0 ? p.settlingSweeps : 0;
    if (settling > 0) settle(state, progress, observe);
    state.report.residual = convergence.residualAfter(settling);
    state.stage = BakeStage::settled;
    observe(state);
}

/// Where nothing emits there is nothing to follow.
void stayDark(BakeState& state) {
    state.indirectVariance.assign(state.irradiance.size(), 0);
    state.reached.assign(state.irradiance.size(), 1);
    state.report.residual = 0;
    state.stage = BakeStage::solved;
}

}  // namespace

void propagate(BakeState& state, Progress& progress, const BakeObserver& observe) {
    const BakeParams& p = state.params;
    if (state.sources.lights.empty() && !state.sources.sky) return stayDark(state);
    if (state.stage < BakeStage::settled) bringToRest(state, progress, observe);
    if (state.stage == BakeStage::solved) return;
    if (refines(p))
        refine(state, progress, observe);
    else
        propagateOnce(state, p.directions, p.cells, -1, progress, observe);
    state.sweep = {};
    state.direct = {};
    state.stage = BakeStage::solved;
    observe(state);
}

}  // namespace vlf
