#pragma once
// A room whose light is solved, timed, for the tables about the error of bakes.

#include "vlf/propagate/bake.h"
#include "vlf/propagate/error_estimate.h"
#include "vlf/propagate/texel_plan.h"

#include <ctime>
#include <utility>

namespace vlf::bench {

/// Without radiance fields.
struct SolvedRoom {
    SolvedRoom(Scene sceneToSolve, BakeParams params)
        : start(std::clock()),
          scene(std::move(sceneToSolve)),
          state(makeState(scene, withPieces(params), progress)) {
        propagate(state, progress);
        error = reportError(state, estimateError(state));
        seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }

    BakeParams& withPieces(BakeParams& params) {
        params.radianceDirections = params.glossDirections = 0;
        if (params.adaptiveTexels) params.pieces = planTexels(scene, params, progress);
        return params;
    }

    std::clock_t start;
    Progress progress;
    Scene scene;
    BakeState state;
    ErrorReport error;
    double seconds = 0;  ///< CPU
};

}  // namespace vlf::bench
