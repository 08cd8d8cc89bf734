#pragma once
// Writes down how an object moves.

#include "vlf/dynamic/motion.h"

namespace vlf {

/// A keyframe without which the motion would be the same, while the object rests, is left out.
class MotionRecorder {
  public:
    /// Times never decrease; of several at one time the last counts.
    void record(double seconds, const Pose& pose, bool visible);

    bool empty() const { return motion_.keyframes.empty(); }

    /// Linear from keyframe to keyframe: every recorded pose is met.
    const KeyframeMotion& motion() const { return motion_; }

  private:
    KeyframeMotion motion_{{}, Interpolation::linear, false};
};

}  // namespace vlf
