#pragma once
// What makes a bake survive its interruption: a checkpoint beside the output, and a lock.

#include "console.h"

#include "vlf/base/file_lock.h"
#include "vlf/io/checkpoint_file.h"
#include "vlf/propagate/bake.h"

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

namespace vlf::app {

/// Holds a file for the one bake that makes it, and clears away what bakes that were killed left of
/// it. Does nothing for a device. Throws FileError if another process holds it.
class BakeOutput {
  public:
    explicit BakeOutput(const std::string& path);

    /// Of its checkpoint; empty for a device.
    const std::string& checkpointPath() const { return checkpointPath_; }

  private:
    std::string checkpointPath_;
    std::optional<FileLock> lock_;
};

/// The checkpoint of one bake, which may or may not exist.
class BakeCheckpoint {
  public:
    /// For the bake of a scene of that hash, with the instruction set in use.
    BakeCheckpoint(std::string path, const BakeParams& params, const std::string& sceneHash);

    const std::string& path() const { return path_; }
    bool exists() const;

    /// With radiance fields in `scratch` where they are large. Throws InputError if it is damaged
    /// or of another bake, saying what differs.
    BakeSolution read(const ScratchPlace& scratch) const;

    /// Throws FileError; a checkpoint that was there is then left as it was.
    void write(const BakeSolution& solution) const;

    void remove() const;

  private:
    std::string path_;
    CheckpointIdentity identity_;
};

/// What a bake goes on from: the checkpoint with `resume`, nothing if there is none, which is said.
/// Throws InputError if there is one without `resume`: work that was kept is not lost unasked.
BakeSolution beginning(const BakeCheckpoint& checkpoint, const ScratchPlace& scratch, bool resume,
                       bool quiet);

/// Shows a bake's progress and keeps its state: every so often, and when it is interrupted.
class CheckpointProgress : public ConsoleProgress {
  public:
    /// A checkpoint every `interval` seconds, or less often where that would take more than a tenth
    /// of the time; 0: none at all.
    CheckpointProgress(bool quiet, const BakeCheckpoint& checkpoint, double interval);

    bool pauseDue() const override;

    /// Writes a checkpoint if one is due or the bake is cancelled. One that cannot be written is
    /// a warning: the bake goes on.
    void keep(const BakeState& state);

  private:
    using Clock = std::chrono::steady_clock;

    void startWaiting(double seconds);
    void write(const BakeState& state);

    const BakeCheckpoint& checkpoint_;
    double interval_;
    std::atomic<Clock::time_point> due_;
    bool warned_ = false;
};

}  // namespace vlf::app
