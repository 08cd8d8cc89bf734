#pragma once
// How an object moves by itself: through keyframes, or along simple paths.

#include "vlf/math/pose.h"

#include <string>
#include <variant>
#include <vector>

namespace vlf {

enum class Interpolation {
    linear,
    smooth,  ///< position and scale by a Catmull-Rom spline
};

/// Where an object is at a time, and whether it is there from then on.
struct Keyframe {
    double seconds = 0;  ///< since the start, in [0, 86400]
    Pose pose;
    bool visible = true;

    friend bool operator==(const Keyframe&, const Keyframe&) = default;
};

/// Through one keyframe or more, whose times increase. Rotations turn the short way, evenly between
/// two keyframes. At rest before the first and after the last, unless it begins again.
struct KeyframeMotion {
    std::vector<Keyframe> keyframes;
    Interpolation interpolation = Interpolation::smooth;
    bool loop = false;

    friend bool operator==(const KeyframeMotion&, const KeyframeMotion&) = default;
};

/// About an axis of the world through the object's own origin.
struct TurnMotion {
    Vec3 axis{0, 1, 0};  ///< unit
    float degreesPerSecond = 45;

    friend bool operator==(const TurnMotion&, const TurnMotion&) = default;
};

/// About an axis through a point.
struct CircleMotion {
    Vec3 centre{0};      ///< metres
    Vec3 axis{0, 1, 0};  ///< unit
    float degreesPerSecond = 45;
    bool turns = true;  ///< shows the point always the same side

    friend bool operator==(const CircleMotion&, const CircleMotion&) = default;
};

/// std::monostate: it stays where it is.
using Motion = std::variant<std::monostate, KeyframeMotion, TurnMotion, CircleMotion>;

inline bool moves(const Motion& motion) {
    return !std::holds_alternative<std::monostate>(motion);
}

/// Throws InputError, with what is wrong, for a motion that cannot be followed.
void requireValid(const Motion& motion);

/// Where an object, placed at `rest`, is at a time, s; keyframes alone say it without `rest`.
/// Precondition: requireValid.
Pose poseAt(const Motion& motion, const Pose& rest, double seconds);

/// Whether it is there: `rest`, unless keyframes say otherwise.
bool visibleAt(const Motion& motion, bool rest, double seconds);

}  // namespace vlf
