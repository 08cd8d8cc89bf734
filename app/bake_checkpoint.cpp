#include "bake_checkpoint.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/propagate/bundle_sweep.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace vlf::app {

namespace fs = std::filesystem;

namespace {

/// Writing checkpoints may take this part of the time.
constexpr double kShare = 0.1;
constexpr double kShortestWait = 0.01;  // seconds: the bake has to get on

using Seconds = std::chrono::duration<double>;

/// A bake without light has found nothing that is worth keeping.
bool isWorthKeeping(const BakeSolution& solution) {
    return solution.stage > BakeStage::charts || countDone(solution.direct.done) > 0 ||
           solution.direct.pass > 0;
}

/// All that has influence on the bits of a bake, by the name of its option where it has one.
CheckpointIdentity identityOf(const BakeParams& params, const std::string& sceneHash) {
    // Names all members: one that is added has to be thought of here. The pieces follow from the
    // rest.
    const auto& [preset, directions, cells, texelSize, texelBudget, directSamples, coarseDirections,
                 coarseCells, maxBounces, tolerance, settlingSweeps, radianceDirections,
                 radianceCells, glossDirections, glossCells, gloss, tileSize, error, seconds,
                 refinements, adaptiveTexels, pieces, seed] = params;
    const auto text = [](const auto& value) { return fmt::format("{}", value); };
    return {{"the program's version", VLF_VERSION},
            {"the scene's fingerprint", sceneHash},
            {"--isa", currentInstructionSet()},
            {"--preset", preset},
            {"--directions", text(directions)},
            {"--cells", text(cells)},
            {"--texel", text(texelSize)},
            {"the budget of texels", text(texelBudget)},
            {"--adaptive-texels", adaptiveTexels ? "yes" : "no"},
            {"--direct-samples", text(directSamples)},
            {"directions of the first sweeps", text(coarseDirections)},
            {"cells of the first sweeps", text(coarseCells)},
            {"--bounces", maxBounces > 0 ? text(maxBounces) : "auto"},
            {"the tolerance", text(tolerance)},
            {"settling sweeps", text(settlingSweeps)},
            {"--radiance-directions", text(radianceDirections)},
            {"--radiance-cells", text(radianceCells)},
            {"--gloss-directions", text(glossDirections)},
            {"--gloss-cells", text(glossCells)},
            {"--gloss-samples", fmt::format("{} and {}", gloss.reflections, gloss.emitters)},
            {"--tile", text(tileSize)},
            {"--error", text(error)},
            {"--seconds", text(seconds)},
            {"--refinements", text(refinements)},
            {"--seed", text(seed)}};
}

/// How far it is, in words.
std::string placeOf(const BakeSolution& solution) {
    switch (solution.stage) {
        case BakeStage::charts:
            return "direct light";
        case BakeStage::directLight:
        case BakeStage::bounce:
            return fmt::format("after {} bounces", solution.report.sweeps);
        case BakeStage::settled:
            return solution.refinement.steps > 0
                       ? fmt::format("after {} steps of refinement", solution.refinement.steps)
                       : "in the last sweep";
        case BakeStage::solved:
            return "the radiance fields";
    }
    return {};
}

}  // namespace

BakeOutput::BakeOutput(const std::string& path) {
    const std::string target = linkTarget(path);
    std::error_code ignored;
    if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) return;
    lock_.emplace(target + ".lock", path);
    checkpointPath_ = target + ".checkpoint";
    removeLeftovers(target);
    removeLeftovers(checkpointPath_);
}

BakeCheckpoint::BakeCheckpoint(std::string path, const BakeParams& params,
                               const std::string& sceneHash)
    : path_(std::move(path)), identity_(identityOf(params, sceneHash)) {}

bool BakeCheckpoint::exists() const {
    std::error_code ignored;
    return !path_.empty() && fs::exists(path_, ignored);
}

BakeSolution BakeCheckpoint::read(const ScratchPlace& scratch) const {
    try {
        const CheckpointReader reader(path_);
        reader.require(identity_);
        BakeSolution solution = solutionIn(scratch);
        visitSolution(solution, reader);
        return solution;
    } catch (const InputError& e) {
        throw InputError(std::string(e.what()) + "; to begin anew, delete it");
    }
}

void BakeCheckpoint::write(const BakeSolution& solution) const {
    CheckpointWriter writer(path_, identity_);
    visitSolution(solution, writer);
    writer.commit();
}

void BakeCheckpoint::remove() const {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
}

BakeSolution beginning(const BakeCheckpoint& checkpoint, const ScratchPlace& scratch, bool resume,
                       bool quiet) {
    const bool exists = checkpoint.exists();
    if (exists && !resume)
        throw InputError(checkpoint.path() +
                         " keeps a bake that was interrupted: go on with --resume, or delete it to "
                         "begin anew");
    if (!resume) return solutionIn(scratch);
    if (!exists) {
        if (!quiet) fmt::print(stderr, "no checkpoint to resume from: beginning anew\n");
        return solutionIn(scratch);
    }
    BakeSolution solution = checkpoint.read(scratch);
    if (!quiet) fmt::print(stderr, "going on from {}: {}\n", checkpoint.path(), placeOf(solution));
    return solution;
}

CheckpointProgress::CheckpointProgress(bool quiet, const BakeCheckpoint& checkpoint,
                                       double interval)
    : ConsoleProgress(quiet),
      checkpoint_(checkpoint),
      interval_(checkpoint.path().empty() ? 0 : interval) {
    startWaiting(interval_);
}

void CheckpointProgress::startWaiting(double seconds) {
    due_.store(Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(seconds)));
}

bool CheckpointProgress::pauseDue() const {
    return interval_ > 0 && Clock::now() >= due_.load(std::memory_order_relaxed);
}

void CheckpointProgress::keep(const BakeState& state) {
    if (interval_ <= 0 || (!cancelled() && !pauseDue())) return;
    const Clock::time_point start = Clock::now();
    if (isWorthKeeping(state)) write(state);
    const Seconds taken = Clock::now() - start;
    startWaiting(std::max({interval_, taken.count() / kShare, kShortestWait}));
}

void CheckpointProgress::write(const BakeState& state) {
    try {
        checkpoint_.write(state);
        if (cancelled()) say(checkpoint_.path() + " keeps the bake: go on with --resume");
    } catch (const FileError& e) {
        if (!warned_ || cancelled()) say(fmt::format("warning: no checkpoint: {}", e.what()));
        warned_ = true;
    }
}

}  // namespace vlf::app
