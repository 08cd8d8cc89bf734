#include "vlf/dynamic/motion_recorder.h"

#include <algorithm>

namespace vlf {

namespace {

bool same(const Keyframe& keyframe, const Pose& pose, bool visible) {
    return keyframe.pose == pose && keyframe.visible == visible;
}

}  // namespace

void MotionRecorder::record(double seconds, const Pose& pose, bool visible) {
    std::vector<Keyframe>& keyframes = motion_.keyframes;
    const std::size_t n = keyframes.size();
    const bool rests =
        n >= 2 && same(keyframes[n - 2], pose, visible) && same(keyframes[n - 1], pose, visible);
    if (n >= 1 && (rests || keyframes[n - 1].seconds >= seconds))
        keyframes.back() = {std::max(seconds, keyframes.back().seconds), pose, visible};
    else
        keyframes.push_back({seconds, pose, visible});
}

}  // namespace vlf
