#include "session.h"

#include "vlf/display/camera_path_file.h"

#include <cmath>

namespace vlf::app {

Session::Session(const SessionOptions& options)
    : options_(options), log_({"objects", "room", "overlay"}) {
    if (options.replay.empty()) return;
    ModelLibrary library;
    std::vector<std::string> warnings;
    Walk walk = readWalk(options.replay, library, warnings);
    path_ = std::move(walk.camera);
    objects_ = std::move(walk.objects);
}

double Session::advance(double seconds) {
    const double before = seconds_;
    if (frames_ > 0) {
        // Not a sum: frame n of a fixed rate is at the same time in every session.
        seconds_ =
            options_.fps > 0 ? static_cast<double>(frames_) / options_.fps : seconds_ + seconds;
    }
    ++frames_;
    return seconds_ - before;
}

std::optional<CameraPose> Session::pose() const {
    if (!path_) return {};
    return path_->at(pathSeconds());
}

double Session::pathSeconds() const {
    const double duration = path_ ? path_->duration() : 0;
    return options_.loop && duration > 0 ? std::fmod(seconds_, duration) : seconds_;
}

bool Session::over() const {
    return path_ && !options_.loop && seconds_ > path_->duration();
}

void Session::note(const FrameRecord& frame, bool jumped, const Objects& objects) {
    if (!options_.record.empty()) {
        if (jumped)
            recorder_.jump(seconds_, frame.pose);
        else
            recorder_.record(seconds_, frame.pose);
        objectRecorder_.record(seconds_, objects);
    }
    if (!options_.log.empty()) log_.add(frame);
}

void Session::finish() const {
    if (!options_.record.empty() && !recorder_.empty())
        writeWalk(options_.record, {recorder_.path(), objectRecorder_.scenario()});
    if (!options_.log.empty()) log_.write(options_.log);
}

}  // namespace vlf::app
