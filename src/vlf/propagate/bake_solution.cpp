#include "vlf/propagate/bake_solution.h"

#include "vlf/base/error.h"
#include "vlf/propagate/bake.h"

#include <algorithm>

namespace vlf {

namespace {

std::size_t blocks(std::size_t items, std::size_t size) {
    return (items + size - 1) / size;
}

bool noneOr(std::size_t size, std::size_t wanted) {
    return size == 0 || size == wanted;
}

bool fits(const DirectLight& light, BakeStage stage, std::size_t texels) {
    return light.pass >= 0 && (stage > BakeStage::charts || light.pass <= kRefinementPasses + 1) &&
           noneOr(light.estimates.size(), texels) &&
           (light.pass == 0 || light.done.empty() || light.before.size() == texels) &&
           noneOr(light.done.size(), blocks(texels, kDirectBlock));
}

bool fits(const Sweep& sweep, const BakeState& state) {
    if (!sweep.isKept(state.stage, state.refinement)) return true;
    if (!noneOr(sweep.nextLine.size(), kAccumulators) || state.stage == BakeStage::charts)
        return false;
    const std::size_t entries = state.unwrap.atlasSize() + 1;
    for (std::size_t a = 0; a < kAccumulators; ++a)
        if ((!sweep.nextLine.empty() && sweep.nextLine[a] % kAccumulators != a) ||
            sweep.bent[a].size() != state.bentTexels.size() ||
            sweep.parts[a].entries().size() != entries)
            return false;
    return noneOr(sweep.gathered.entries().size(), entries) &&
           noneOr(sweep.toppedUp.size(), blocks(state.unwrap.texels.size(), kTopUpBlock));
}

}  // namespace

BakeSolution solutionIn(const ScratchPlace& scratch) {
    const RadianceElements none{ScratchAllocator<RadianceElement>(scratch)};
    BakeSolution solution;
    solution.radiance.field.elements = none;
    solution.gloss.field.elements = none;
    return solution;
}

void checkSolution(const BakeState& s) {
    const std::size_t texels = s.unwrap.texels.size();
    const std::size_t lit = s.stage == BakeStage::charts ? 0 : texels;
    const bool fitting =
        s.stage >= BakeStage::charts && s.stage <= BakeStage::solved &&
        fits(s.direct, s.stage, texels) && s.directIrradiance.size() == lit &&
        s.directVariance.size() == lit && noneOr(s.indirectVariance.size(), lit) &&
        s.irradiance.size() == lit && s.reached.size() == lit &&
        noneOr(s.convergence.charts.size(), s.unwrap.charts.size()) && s.settling.sweeps >= 0 &&
        noneOr(s.settling.sum.size(), texels) && fits(s.sweep, s) &&
        noneOr(s.radiance.done.size(), 2 * static_cast<std::size_t>(s.params.radianceDirections)) &&
        (!s.needsDirectEstimates(refines(s.params)) || s.direct.estimates.size() == texels) &&
        noneOr(s.gloss.done.size(), 2 * static_cast<std::size_t>(s.params.glossDirections));
    if (!fitting) throw InputError("what was baked before is not of this scene");
}

}  // namespace vlf
