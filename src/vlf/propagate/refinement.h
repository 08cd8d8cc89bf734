#pragma once
// Sampling on until the estimated error is small enough or the time is up: sweeps and shadow rays
// where they take most of the error away for their work.

#include "vlf/base/progress.h"

#include <chrono>
#include <cstdint>
#include <functional>

namespace vlf {

struct BakeParams;
struct BakeState;

enum class RefinementStep : std::int32_t { none, sweep, direct };

/// What a refinement has done and is at. What comes next depends on this and the estimates alone,
/// never on the clock, so that as many steps give the same bits again.
struct Refinement {
    RefinementStep step = RefinementStep::none;  ///< under way
    std::int32_t lines = 0;                      ///< of that, if it is a sweep
    double directTarget = 0;  ///< of that, if it is direct light: Σ A s² over the texels, W²·m⁻²
    std::int32_t steps = 0;   ///< that have ended; the first is a sweep
    std::uint64_t sweptLines = 0, exchanges = 0;  ///< of the sweeps among them
};

/// What the steps of this process took, to foretell the next one; only BakeParams::seconds asks.
struct RefinementClock {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    double sweepSeconds = 0, directSeconds = 0;
    std::uint64_t lines = 0, exchanges = 0, samples = 0;

    double elapsed() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

/// The parameters from which a bake that ends at this relative error of its texels, 0.01 = 1 %,
/// sets out: few directions and samples, to which the refinement adds. Texels and cells stay. 0:
/// for a bake that ends in time.
BakeParams refiningParams(BakeParams params, double error);

/// The largest direction set of about this many lines, or the smallest there is.
std::int32_t nearestSet(double lines);

/// Whether the parameters ask for more than one fine sweep.
bool refines(const BakeParams& params);

/// The fine sweeps and what is between them, for a state that has come to rest. Throws InputError
/// if the error asked for is out of reach, saying what to change.
void refine(BakeState& state, Progress& progress,
            const std::function<void(const BakeState&)>& observe);

}  // namespace vlf
