#include "vlf/live/bake_ladder.h"

#include <algorithm>

namespace vlf {

namespace {

/// About a quarter of the work of "draft".
BakeParams previewParams() {
    BakeParams p = presetParams("draft");
    p.preset = "preview";
    p.directions = 129;
    p.cells = 96;
    p.texelBudget = 6000;
    p.directSamples = 1;
    p.coarseCells = 64;
    p.tolerance = 2e-2;
    p.radianceDirections = 129;
    p.radianceCells = 64;
    p.glossDirections = 129;
    p.glossCells = 32;
    p.gloss = {8, 4};
    return p;
}

}  // namespace

std::vector<BakeParams> bakeLadder(const BakeParams& wanted) {
    std::vector<BakeParams> rungs{previewParams()};
    for (const char* preset : {"draft", "standard", "high"}) {
        if (preset == wanted.preset) break;
        rungs.push_back(presetParams(preset));
    }
    for (BakeParams& p : rungs) {
        p.seed = wanted.seed;
        p.maxBounces = wanted.maxBounces;
        p.radianceDirections = std::min(p.radianceDirections, wanted.radianceDirections);
        p.glossDirections = std::min(p.glossDirections, wanted.glossDirections);
    }
    rungs.push_back(wanted);
    return rungs;
}

}  // namespace vlf
