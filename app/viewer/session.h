#pragma once
// What of a walk is written down or read again: the way of the camera, what objects did, and every
// frame's times.

#include "object_recorder.h"

#include "vlf/display/camera_path.h"
#include "vlf/display/frame_log.h"

#include <optional>
#include <string>

namespace vlf::app {

struct SessionOptions {
    std::string record;                ///< camera path to write; empty: none
    std::optional<CameraPath> replay;  ///< camera path to follow; none: the user walks
    std::string log;                   ///< frame log to write; empty: none
    double fps = 0;     ///< frames a second of the session's time; 0: as fast as they come
    bool loop = false;  ///< the replay begins again when it ends
};

class Session {
  public:
    explicit Session(const SessionOptions& options);

    /// A frame begins, `seconds` after the one before; returns the time between the two in the
    /// session.
    double advance(double seconds);

    /// Where the path that is followed has the camera now; none: the user walks.
    std::optional<CameraPose> pose() const;

    /// The path that was followed has ended.
    bool over() const;

    /// What the frame has shown and taken. Of its passes: the light of objects, the room, what lies
    /// over it. `jumped`: the walker did not go there from where he was.
    void note(const FrameRecord& frame, bool jumped, const Objects& objects);

    /// Writes what was recorded. Throws FileError.
    void finish() const;

    double seconds() const { return seconds_; }  ///< since the start

    /// On the path that is followed, or else since the start.
    double pathSeconds() const;

  private:
    SessionOptions options_;
    PathRecorder recorder_;
    ObjectRecorder objectRecorder_;
    FrameLog log_;
    double seconds_ = 0;
    std::uint64_t frames_ = 0;
};

}  // namespace vlf::app
