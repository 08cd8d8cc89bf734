#pragma once
// Baking beside a window: a scene's light in states that get better, again whenever its files are
// changed. Whoever shows it polls, a frame at a time.

#include "vlf/live/live_board.h"
#include "vlf/propagate/bake.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace vlf {

struct LiveOptions {
    int niceness = 10;  ///< of the working threads, against the process, see BackgroundWork
    int threads = 0;    ///< that work; 0: one per core
    /// States between the first light and the finished one come no closer than this.
    std::chrono::milliseconds interval{50};
    /// How often the files are looked at; a change shows at the second look.
    std::chrono::milliseconds watchInterval{250};
    Environment environment;     ///< of the scene, whose files have none
    std::string programVersion;  ///< for the record of finished fields
};

/// Reads scene files and bakes them in threads of its own, over a ladder of presets (bakeLadder) to
/// `wanted`. The first room is shown with every state that its light goes through; later ones, of
/// finer presets or of changed files, when their light is no worse than what is shown. The last
/// state is what bake() makes of the same scene and parameters, to the bit.
///
/// When one of the files, or one that they name, is changed on disk, the files are read again; what
/// cannot be read leaves the bake before, if any, as it is and is told in status().error.
///
/// To be used by one thread at a time. Only finished() may wait, for another thread to swap a
/// pointer.
class LiveBake {
  public:
    LiveBake(std::vector<std::string> sceneFiles, BakeParams wanted, LiveOptions options = {});
    ~LiveBake();  ///< cancels; waits for the end of a reading of files
    LiveBake(const LiveBake&) = delete;
    LiveBake& operator=(const LiveBake&) = delete;

    /// The newest state, if there has been one since the last call.
    std::optional<LiveUpdate> poll();

    LiveStatus status() const;

    /// The newest room whose preset is finished, for writeField; null: none yet of the files as
    /// they are. Its scene has a camera, its record is whole.
    std::shared_ptr<const BakedRoom> finished() const;

  private:
    LiveBoard board_;
    std::jthread watcher_;
};

}  // namespace vlf
