#pragma once
// A live bake as the window shows it: its news, what it is doing, and saving what it has made.

#include "vlf/live/live_bake.h"

#include <functional>
#include <future>
#include <optional>
#include <string>

namespace vlf::app {

class LiveView {
  public:
    /// Told in a few words what has happened.
    using Say = std::function<void(const std::string&)>;

    /// `bake` must outlive it. `output`: field file to write when the bake is done, and when asked
    /// to; empty: a new file STEM-NNNN.vlf, when asked to.
    LiveView(LiveBake& bake, std::string stem, std::string output, Say say);
    /// The newest state, if there is a new one; to be called once a frame.
    std::optional<LiveUpdate> poll();

    /// What the bake is doing, in a line; empty: it is done.
    std::string activity() const;

    /// Why the files as they are cannot be shown; empty: they are.
    std::string problem() const { return bake_.status().error; }

    /// Writes the newest finished room, in the background.
    void save();

    /// To be called in the end: writes `output` with what there is, unless that has been done, and
    /// waits for it.
    void finish();

  private:
    void reportSaved();

    LiveBake& bake_;
    std::string stem_, output_;
    Say say_;
    bool unsaved_;                     ///< `output` is to be written
    std::future<std::string> saving_;  ///< what to say of it
};

}  // namespace vlf::app
