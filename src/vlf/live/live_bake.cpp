#include "vlf/live/live_bake.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/base/watched_files.h"
#include "vlf/live/bake_ladder.h"
#include "vlf/propagate/entering_light.h"
#include "vlf/propagate/fill_atlas.h"
#include "vlf/scene/import/import.h"
#include "vlf/scene/scene_hash.h"

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <utility>

namespace vlf {

namespace {

using Clock = std::chrono::steady_clock;

/// Tells the board; is cancelled when its thread is to stop.
class LiveProgress : public Progress {
  public:
    LiveProgress(LiveBoard& board, const std::stop_token& stop)
        : board_(board), onStop_(stop, [this] { cancel(); }) {}

    void stage(const std::string& name) override {
        board_.note([&](LiveStatus& s) {
            s.activity = name;
            s.fraction = 0;
        });
    }
    void update(double fraction) override {
        board_.note([&](LiveStatus& s) { s.fraction = fraction; });
    }

  private:
    LiveBoard& board_;
    std::stop_callback<std::function<void()>> onStop_;
};

/// The irradiance of a closed room that spreads its light evenly: emitted = absorbed.
IrradianceAtlas evenIrradiance(const BakeState& state) {
    Vec3 emitted(0);
    for (const Light& light : state.sources.lights) emitted += kPi * light.area * light.radiance;
    emitted += emittedFlux(state.scene, state.rays, state.sources.sky.get());
    float absorbing = 0, whole = 0;  // m²
    for (std::size_t i = 0; i < state.absorptance.size(); ++i) {
        absorbing += state.unwrap.texelArea(i) * luminance(state.absorptance[i]);
        whole += state.unwrap.texelArea(i);
    }
    constexpr float kLeastAbsorptance = 0.1f;  // of a room, all in all
    const float area = std::max(absorbing, kLeastAbsorptance * whole);
    const Unwrap& u = state.unwrap;
    return {u.atlasWidth, u.atlasHeight, std::vector<Vec3>(u.atlasSize(), emitted / area)};
}

/// One scene, from the first picture to the wanted bake.
class LadderBake {
  public:
    /// `lightShown`: whether a room with all of its light is shown already. Until then any light
    /// is better than none.
    LadderBake(Scene scene, const LiveOptions& options, LiveBoard& board, bool& lightShown)
        : scene_(std::move(scene)), options_(options), board_(board), lightShown_(lightShown) {}

    /// Throws Cancelled, and InputError for parameters that do not suit the scene.
    void run(const BakeParams& wanted, Progress& progress) {
        const std::vector<BakeParams> rungs = bakeLadder(wanted);
        for (std::size_t i = 0; i < rungs.size(); ++i)
            climb(rungs[i], i + 1 == rungs.size(), progress);
    }

  private:
    void climb(const BakeParams& params, bool last, Progress& progress) {
        board_.note([&](LiveStatus& s) { s.preset = params.preset; });
        roomShown_ = false;
        BakeReport report;
        const auto observe = [&](const BakeState& state) {
            progress.check();
            this->observe(state);
        };
        const auto room = std::make_shared<BakedRoom>();
        room->field = bake(scene_, params, progress, &report, observe);
        room->scene = scene_;
        room->field.record.programVersion = options_.programVersion;
        room->field.record.sceneHash = sceneHash(scene_);
        progress.check();
        board_.setFinished(room);
        // Without mirrors only the light differs from the room that was shown last.
        const bool sameButLight = roomShown_ && room->field.radiance.empty();
        post({.room = sameButLight ? nullptr : room,
              .irradiance = {room, &room->field.atlas},
              .stage = LiveStage::finished,
              .bounces = report.sweeps,
              .complete = last},
             params);
    }

    void observe(const BakeState& state) {
        board_.note([&](LiveStatus& s) { s.missingLight = state.report.residual; });
        if (lightShown_ && state.stage != BakeStage::settled) return;
        switch (state.stage) {
            case BakeStage::charts:
                return show(state, LiveStage::estimated);
            case BakeStage::directLight:
                return show(state, LiveStage::directLight);
            case BakeStage::bounce:
                if (Clock::now() >= nextState_) show(state, LiveStage::bounce);
                return;
            case BakeStage::settled:
                return show(state, LiveStage::settled);
            case BakeStage::solved:
                return;  // the finished room follows
        }
    }

    /// Posts the state: with its charts the first time, then its light alone.
    void show(const BakeState& state, LiveStage stage) {
        auto light = std::make_shared<IrradianceAtlas>(
            stage == LiveStage::estimated ? evenIrradiance(state) : fillAtlas(state));
        LiveUpdate update{.stage = stage, .bounces = state.report.sweeps};
        if (!roomShown_) {
            const auto room = std::make_shared<BakedRoom>(BakedRoom{scene_, unlitField(state)});
            room->field.atlas = std::move(*light);
            light = {room, &room->field.atlas};
            update.room = room;
            roomShown_ = true;
        }
        update.irradiance = std::move(light);
        post(std::move(update), state.params);
        nextState_ = Clock::now() + options_.interval;
    }

    void post(LiveUpdate update, const BakeParams& params) {
        update.preset = params.preset;
        if (update.stage >= LiveStage::settled) lightShown_ = true;
        board_.post(std::move(update));
    }

    Scene scene_;
    const LiveOptions& options_;
    LiveBoard& board_;
    bool& lightShown_;
    bool roomShown_ = false;  // with the charts of the present bake
    Clock::time_point nextState_{};
};

/// Reads the files and keeps a bake of what they last held going.
class Watcher {
  public:
    Watcher(std::vector<std::string> sceneFiles, BakeParams wanted, LiveOptions options,
            LiveBoard& board)
        : sceneFiles_(std::move(sceneFiles)),
          wanted_(std::move(wanted)),
          options_(std::move(options)),
          board_(board) {}

    void run(const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            WatchedFiles files = read(stop);
            while (!files.changed() && !stop.stop_requested()) sleep(stop);
        }
    }

  private:
    /// Starts a bake if the files can be read. The files that were looked at.
    WatchedFiles read(const std::stop_token& stop) {
        if (!baker_.joinable()) board_.note([](LiveStatus& s) { s.activity = "reading"; });
        ImportReport report;
        try {
            Scene scene;
            runInBackground(0, options_.threads, [&] { scene = importScene(sceneFiles_, report); });
            if (stop.stop_requested()) return {};
            scene.environment = options_.environment;
            start(std::move(scene), std::move(report.warnings));
        } catch (const std::exception& e) {
            board_.note([&](LiveStatus& s) {
                s.error = e.what();
                if (!baker_.joinable()) s.activity.clear();
            });
        }
        return WatchedFiles(std::move(report.files));
    }

    void start(Scene scene, std::vector<std::string> warnings) {
        if (scene.cameras.empty()) scene.cameras.push_back(defaultCamera(scene));
        if (!hasLight(scene))
            warnings.emplace_back("the scene has no emitter: everything will be black");
        baker_ = {};  // the bake before ends here
        board_.setFinished(nullptr);
        board_.note([&](LiveStatus& s) { s = {.warnings = std::move(warnings)}; });
        baker_ =
            std::jthread([this, scene = std::move(scene)](const std::stop_token& stop) mutable {
                runInBackground(options_.niceness, options_.threads,
                                [&] { bakeScene(std::move(scene), stop); });
            });
    }

    void bakeScene(Scene scene, const std::stop_token& stop) {
        LiveProgress progress(board_, stop);
        std::string error;
        try {
            LadderBake(std::move(scene), options_, board_, lightShown_).run(wanted_, progress);
        } catch (const Cancelled&) {
            return;
        } catch (const std::exception& e) {
            error = e.what();
        }
        board_.note([&](LiveStatus& s) {
            s.activity.clear();
            s.complete = error.empty();
            if (!error.empty()) s.error = error;  // else files that were broken since still are
        });
    }

    void sleep(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, stop, options_.watchInterval, [] { return false; });
    }

    std::vector<std::string> sceneFiles_;
    BakeParams wanted_;
    LiveOptions options_;
    LiveBoard& board_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    bool lightShown_ = false;  // of the baker
    std::jthread baker_;
};

}  // namespace

LiveBake::LiveBake(std::vector<std::string> sceneFiles, BakeParams wanted, LiveOptions options)
    : watcher_([watcher = std::make_shared<Watcher>(std::move(sceneFiles), std::move(wanted),
                                                    std::move(options), board_)](
                   const std::stop_token& stop) { watcher->run(stop); }) {}

LiveBake::~LiveBake() = default;

std::optional<LiveUpdate> LiveBake::poll() {
    return board_.takeUpdate();
}

LiveStatus LiveBake::status() const {
    return board_.status();
}

std::shared_ptr<const BakedRoom> LiveBake::finished() const {
    return board_.finished();
}

}  // namespace vlf
