#include "session.h"

#include "vlf/display/camera_path_file.h"

#include <cmath>

namespace vlf::app {

Session::Session(const SessionOptions& options)
    : options_(options), log_({"objects", "room", "overlay"}) {}

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
    if (!options_.replay) return {};
    return options_.replay->at(pathSeconds());
}

double Session::pathSeconds() const {
    const double duration = options_.replay ? options_.replay->duration() : 0;
    return options_.loop && duration > 0 ? std::fmod(seconds_, duration) : seconds_;
}

bool Session::over() const {
    return options_.replay && !options_.loop && seconds_ > options_.replay->duration();
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
