#pragma once
// What a bake has found so far and how far it is: all that it needs, besides the scene and the
// parameters, to go on to the same bits.

#include "vlf/field/light_field.h"
#include "vlf/propagate/bent_texels.h"
#include "vlf/propagate/convergence.h"
#include "vlf/propagate/direct_light.h"
#include "vlf/propagate/error_estimate.h"
#include "vlf/propagate/radiance_bake.h"
#include "vlf/propagate/refinement.h"
#include "vlf/propagate/texel_buffer.h"

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace vlf {

/// How far a bake has come.
enum class BakeStage : std::int32_t {
    charts,       ///< charts, texels and light sources are known, light is not
    directLight,  ///< the field after zero bounces
    bounce,       ///< one more coarse bounce
    settled,      ///< the coarse bounces are done; the fine one follows
    solved        ///< the irradiance is known; the radiance field follows
};

/// Directions of a sweep are dealt to this many accumulators, added up in order: the sum is the
/// same for any number of threads.
inline constexpr std::size_t kAccumulators = 8;

/// Texels that gather by rays of their own are worked off in blocks of so many.
inline constexpr std::size_t kTopUpBlock = 256;

/// A sweep under way: accumulator a takes the lines a, a + kAccumulators, ...
struct Sweep {
    std::vector<std::uint32_t> nextLine;  ///< by accumulator; empty: no sweep is under way
    std::array<std::uint64_t, kAccumulators> exchanges{};
    std::array<std::vector<BentSum>, kAccumulators> bent;
    std::array<TexelBuffer, kAccumulators> parts;  ///< what the texels gather
    TexelBuffer gathered;                          ///< the sum of the parts, once all have ended
    LoopMarks toppedUp;                            ///< blocks of texels

    /// Whether the parts matter: a sweep is under way, or one more may follow on top.
    bool isKept(BakeStage stage, const Refinement& refinement) const {
        return !nextLine.empty() || (stage < BakeStage::solved && refinement.sweptLines > 0);
    }
};

/// The mean over the last coarse sweeps, under way.
struct Settling {
    std::int32_t sweeps = 0;
    std::vector<Vec3> sum;  ///< of irradiance over the later half
};

/// Seconds and counts, for people and benchmarks.
struct BakeReport {
    struct Stage {
        std::string name;
        double seconds = 0;     ///< wall clock
        double cpuSeconds = 0;  ///< of all threads of the process
    };
    std::vector<Stage> stages;  ///< of this process, without what it went on from
    /// Texels of the pieces of one scale, see TexelPiece.
    struct TexelScale {
        float scale = 1;
        std::size_t texels = 0;
    };
    std::vector<TexelScale> texelScales;  ///< ascending
    std::size_t texels = 0;
    std::size_t radianceElements = 0;  ///< of perfect and rough mirrors
    std::uint64_t exchanges = 0;
    int sweeps = 0;
    int refinements = 0;             ///< steps of the refinement
    std::uint64_t finalLines = 0;    ///< of its sweeps
    double residual = 1;             ///< estimated light still missing, relative
    ErrorReport error;               ///< estimated
    std::vector<float> texelErrors;  ///< estimated, see relativeErrors
    EnergyReport energy;
};

/// Irradiances are per entry of unwrap.texels, W·m⁻².
struct BakeSolution {
    BakeStage stage = BakeStage::charts;
    BakeReport report;
    DirectLight direct;
    std::vector<Vec3> directIrradiance;
    std::vector<float> directVariance;    ///< (W·m⁻²)², summed over the channels
    std::vector<float> indirectVariance;  ///< the same, once the last sweep has ended
    std::vector<Vec3> irradiance;         ///< direct and all bounces so far
    std::vector<std::uint8_t> reached;    ///< whether any ray has met the texel
    ConvergenceHistory convergence;
    Settling settling;
    Refinement refinement;
    Sweep sweep;
    PartialRadiance radiance, gloss;  ///< of perfect and rough mirrors

    /// Whether a bake that refines or not goes on from what is known of each texel's direct light.
    bool needsDirectEstimates(bool refining) const {
        return refining && stage > BakeStage::charts && stage < BakeStage::solved;
    }
};

/// Calls visit(name, member) for all that has to be kept of a solution, so that whatever keeps it
/// need not know what it is. Members are vectors and values of trivially copyable types; names have
/// up to 16 characters. S is BakeSolution or const BakeSolution. A visitor that reads fills one
/// that is new.
template <class S, class Visit>
    requires std::is_same_v<std::remove_const_t<S>, BakeSolution>
void visitSolution(S& solution, Visit&& visit) {
    // Names all members: one that is added has to be thought of here.
    auto& [stage, report, direct, directIrradiance, directVariance, indirectVariance, irradiance,
           reached, convergence, settling, refinement, sweep, radiance, gloss] = solution;
    visit("stage", stage);
    visit("exchanges", report.exchanges);
    visit("sweeps", report.sweeps);
    visit("residual", report.residual);
    visit("direct.pass", direct.pass);
    visit("direct.done", direct.done);
    visit("direct.estimates", direct.estimates);
    visit("direct.before", direct.before);
    visit("direct", directIrradiance);
    visit("direct.variance", directVariance);
    visit("variance", indirectVariance);
    visit("irradiance", irradiance);
    visit("reached", reached);
    visit("history.charts", convergence.charts);
    visit("history.growth", convergence.growth);
    visit("history.bounces", convergence.bounces);
    visit("history.residual", convergence.residual);
    visit("history.rate", convergence.rate);
    visit("settling.sweeps", settling.sweeps);
    visit("settling.sum", settling.sum);
    visit("refinement", refinement);
    visit("error", report.error);
    visit("sweep.next", sweep.nextLine);
    if (sweep.isKept(stage, refinement)) {
        visit("sweep.exchanges", sweep.exchanges);
        for (std::size_t a = 0; a < kAccumulators; ++a) {
            visit("sweep.bent " + std::to_string(a), sweep.bent[a]);
            visit("sweep.part " + std::to_string(a), sweep.parts[a].entries());
        }
        visit("sweep.gathered", sweep.gathered.entries());
        visit("sweep.topped-up", sweep.toppedUp);
    }
    visit("radiance", radiance.field.elements);
    visit("radiance.done", radiance.done);
    visit("gloss", gloss.field.elements);
    visit("gloss.done", gloss.done);
}

/// One that has nothing yet and whose radiance fields live in files of `scratch` where they are
/// large.
BakeSolution solutionIn(const ScratchPlace& scratch);

struct BakeState;

/// Throws InputError if the solution that the state is to go on from is not of its scene.
void checkSolution(const BakeState& state);

}  // namespace vlf
