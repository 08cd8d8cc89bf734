#pragma once
// The way of a camera through a room: what a session records, a replay repeats and a film shows.

#include "vlf/display/camera_pose.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace vlf {

/// Where the camera is at a time.
struct CameraSample {
    double seconds = 0;  ///< since the start, >= 0
    CameraPose pose;

    bool operator==(const CameraSample&) const = default;
};

/// A smooth way through samples: eye, yaw, pitch and field of view each by a monotone cubic
/// [Fritsch & Butland, A method for constructing local monotone piecewise cubic interpolants, SIAM
/// J. Sci. Stat. Comput. 5(2), 1984]. Unlike a Catmull-Rom spline it never leaves the box of two
/// neighbouring samples, so that a path that was walked does not swing through a wall, and rests
/// where two samples are equal. Dense samples, as recorded, and a few, as written by hand, are thus
/// treated alike.
class CameraPath {
  public:
    /// Throws InputError, naming `nameForErrors` and the sample, if there is none, the times do not
    /// increase or exceed a day, or a value is out of the range that CameraPose states.
    explicit CameraPath(std::vector<CameraSample> samples,
                        const std::string& nameForErrors = "camera path");

    const std::vector<CameraSample>& samples() const { return samples_; }

    /// Time of the last sample, s.
    double duration() const { return samples_.back().seconds; }

    /// The pose at a time, s; before the first sample the first, after the last the last. Turns the
    /// short way; its yaw may exceed a full turn.
    CameraPose at(double seconds) const;

  private:
    static constexpr int kCurves = 6;  // eye, yaw, pitch, field of view
    using Values = std::array<double, kCurves>;

    std::vector<CameraSample> samples_;
    std::vector<Values> values_, slopes_;  ///< of the curves at the samples; yaw without jumps
};

/// Records a walk. A sample without which the path would be the same, while the walker rests, is
/// left out.
class PathRecorder {
  public:
    /// The walker's pose at a time in seconds since the start. Less than a microsecond after the
    /// last one it replaces that.
    void record(double seconds, const CameraPose& pose);

    /// As record, but the walker did not go there: the pose is the last one until a moment before,
    /// so that a replay shows nothing from between.
    void jump(double seconds, const CameraPose& pose);

    bool empty() const { return samples_.empty(); }

    /// Throws InputError if nothing was recorded.
    CameraPath path() const { return CameraPath(samples_, "recorded camera path"); }

  private:
    std::vector<CameraSample> samples_;
};

/// From camera to camera in a straight line, at rest for a second at each, at a walker's speed.
/// Nothing keeps it from passing through a wall. Throws InputError if there are less than two.
CameraPath tour(std::span<const Camera> cameras);

}  // namespace vlf
