#pragma once
// Where a live bake leaves what it has for whoever shows it.

#include "vlf/io/field_file.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace vlf {

/// How good the light of an update is.
enum class LiveStage {
    estimated,    ///< the same everywhere: as if the room reflected all light evenly
    directLight,  ///< of the emitters alone
    bounce,       ///< and of some bounces
    settled,      ///< all bounces, some noise
    finished      ///< of one preset
};

/// News of a live bake.
struct LiveUpdate {
    /// A room to show in place of the one before; null: that one keeps its charts and all but
    /// its irradiance.
    std::shared_ptr<const BakedRoom> room = nullptr;
    /// The irradiance of the room that is shown now; never null.
    std::shared_ptr<const IrradianceAtlas> irradiance = nullptr;
    LiveStage stage = LiveStage::estimated;
    int bounces = 0;        ///< sweeps done
    std::string preset{};   ///< "preview", "draft", ... of the bake that this is from
    bool complete = false;  ///< finished, and nothing better will follow
};

/// What a live bake is doing.
struct LiveStatus {
    std::string preset{};     ///< of the bake under way; empty before the first
    std::string activity{};   ///< e.g. "reading", "charts", "bounces"; empty: nothing to do
    double fraction = 0;      ///< of the activity, as far as it is known
    double missingLight = 1;  ///< estimated share of the light that is still missing
    bool complete = false;    ///< the wanted bake is done
    std::string error{};      ///< why the files as they are cannot be shown; empty: they are
    std::vector<std::string> warnings{};  ///< of reading the files that are shown
};

/// Passes news and status from working threads to one that shows them, which never waits: where it
/// finds the board in use it goes on with what it had.
class LiveBoard {
  public:
    std::optional<LiveUpdate> takeUpdate();
    LiveStatus status() const;
    std::shared_ptr<const BakedRoom> finished() const;

    /// An update that is not taken before the next is replaced by it, room and all.
    void post(LiveUpdate update);

    /// Changes the status by `change(LiveStatus&)`.
    template <class Change>
    void note(Change change) {
        const std::lock_guard lock(mutex_);
        change(status_);
    }

    /// The newest room that is worth saving; null: none of the present scene.
    void setFinished(std::shared_ptr<const BakedRoom> room);

  private:
    mutable std::mutex mutex_;
    std::optional<LiveUpdate> update_;
    LiveStatus status_;
    std::shared_ptr<const BakedRoom> finished_;
    mutable LiveStatus lastRead_;  // of the showing thread alone
};

}  // namespace vlf
