#include "vlf/dynamic/motion.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vlf {

namespace {

constexpr double kDay = 86400;

double timeWithin(const KeyframeMotion& motion, double seconds) {
    const double first = motion.keyframes.front().seconds, last = motion.keyframes.back().seconds;
    if (motion.loop && last > 0 && seconds > last) seconds = std::fmod(seconds, last);
    return std::clamp(seconds, first, last);
}

/// Number of the last keyframe that is not after `seconds`; of the first, if all are.
std::size_t keyframeAt(const KeyframeMotion& motion, double seconds) {
    const auto after =
        std::upper_bound(motion.keyframes.begin(), motion.keyframes.end(), seconds,
                         [](double s, const Keyframe& keyframe) { return s < keyframe.seconds; });
    return static_cast<std::size_t>(
        std::max<std::ptrdiff_t>(after - motion.keyframes.begin() - 1, 0));
}

/// What the spline runs through: position, and the logarithm of the scale, which stays above zero.
Vec4 curveAt(const Keyframe& keyframe) {
    return {keyframe.pose.translation, std::log(keyframe.pose.scale)};
}

/// Change of the curve a second at keyframe `i`, by its neighbours; a motion that ends where it
/// began and begins again passes its end without a kink.
Vec4 slopeAt(const KeyframeMotion& motion, std::size_t i) {
    const std::vector<Keyframe>& keys = motion.keyframes;
    const std::size_t last = keys.size() - 1;
    const bool closed = motion.loop && last > 1 && curveAt(keys[0]) == curveAt(keys[last]);
    if (closed && (i == 0 || i == last)) {
        const double seconds =
            keys[1].seconds - keys[0].seconds + keys[last].seconds - keys[last - 1].seconds;
        return (curveAt(keys[1]) - curveAt(keys[last - 1])) / static_cast<float>(seconds);
    }
    const Keyframe& before = keys[i == 0 ? 0 : i - 1];
    const Keyframe& after = keys[std::min(i + 1, last)];
    return (curveAt(after) - curveAt(before)) / static_cast<float>(after.seconds - before.seconds);
}

/// Cubic Hermite curve between keyframes i and i + 1.
Vec4 splineAt(const KeyframeMotion& motion, std::size_t i, float u) {
    const auto length =
        static_cast<float>(motion.keyframes[i + 1].seconds - motion.keyframes[i].seconds);
    const float u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * curveAt(motion.keyframes[i]) +
           (3 * u2 - 2 * u3) * curveAt(motion.keyframes[i + 1]) +
           length * ((u3 - 2 * u2 + u) * slopeAt(motion, i) + (u3 - u2) * slopeAt(motion, i + 1));
}

Pose poseOn(const KeyframeMotion& motion, double seconds) {
    const double time = timeWithin(motion, seconds);
    const std::size_t i = keyframeAt(motion, time);
    const Keyframe& from = motion.keyframes[i];
    if (time <= from.seconds || i + 1 == motion.keyframes.size()) return from.pose;
    const Keyframe& to = motion.keyframes[i + 1];
    const bool linear = motion.interpolation == Interpolation::linear;
    if (linear && from.pose == to.pose) return from.pose;
    const auto u = static_cast<float>((time - from.seconds) / (to.seconds - from.seconds));
    Pose pose;
    pose.rotation = glm::normalize(glm::slerp(from.pose.rotation, to.pose.rotation, u));
    if (linear) {
        pose.translation = glm::mix(from.pose.translation, to.pose.translation, u);
        pose.scale = glm::mix(from.pose.scale, to.pose.scale, u);
    } else {
        const Vec4 curve = splineAt(motion, i, u);
        pose.translation = Vec3(curve);
        pose.scale = std::exp(curve.w);
    }
    return pose;
}

Quat turned(const Vec3& axis, float degreesPerSecond, double seconds) {
    const double degrees = std::fmod(degreesPerSecond * seconds, 360.0);
    return glm::angleAxis(static_cast<float>(degrees * std::numbers::pi / 180), axis);
}

void requireTurning(const Vec3& axis, float degreesPerSecond) {
    if (!(std::abs(glm::length(axis) - 1) < 1e-3f))
        throw InputError("the axis of a turn must be of length one");
    if (!std::isfinite(degreesPerSecond)) throw InputError("the speed of a turn must be finite");
}

void requireKeyframes(const KeyframeMotion& motion) {
    if (motion.keyframes.empty()) throw InputError("a motion needs one keyframe at least");
    double before = -1;
    for (const Keyframe& keyframe : motion.keyframes) {
        if (!(keyframe.seconds >= 0 && keyframe.seconds <= kDay))
            throw InputError(fmt::format("times of keyframes must be from 0 to {} s", kDay));
        if (keyframe.seconds <= before) throw InputError("times of keyframes must increase");
        if (!isValid(keyframe.pose))
            throw InputError(fmt::format("the keyframe at {} s is no pose", keyframe.seconds));
        before = keyframe.seconds;
    }
}

}  // namespace

void requireValid(const Motion& motion) {
    if (const auto* keyframes = std::get_if<KeyframeMotion>(&motion)) requireKeyframes(*keyframes);
    if (const auto* turn = std::get_if<TurnMotion>(&motion))
        requireTurning(turn->axis, turn->degreesPerSecond);
    if (const auto* circle = std::get_if<CircleMotion>(&motion)) {
        requireTurning(circle->axis, circle->degreesPerSecond);
        if (!isFinite(circle->centre)) throw InputError("the centre of a circle must be finite");
    }
}

Pose poseAt(const Motion& motion, const Pose& rest, double seconds) {
    if (const auto* keyframes = std::get_if<KeyframeMotion>(&motion))
        return poseOn(*keyframes, seconds);
    Pose pose = rest;
    if (const auto* turn = std::get_if<TurnMotion>(&motion))
        pose.rotation =
            glm::normalize(turned(turn->axis, turn->degreesPerSecond, seconds) * rest.rotation);
    if (const auto* circle = std::get_if<CircleMotion>(&motion)) {
        const Quat rotation = turned(circle->axis, circle->degreesPerSecond, seconds);
        pose.translation = circle->centre + rotation * (rest.translation - circle->centre);
        if (circle->turns) pose.rotation = glm::normalize(rotation * rest.rotation);
    }
    return pose;
}

bool visibleAt(const Motion& motion, bool rest, double seconds) {
    const auto* keyframes = std::get_if<KeyframeMotion>(&motion);
    if (!keyframes) return rest;
    return keyframes->keyframes[keyframeAt(*keyframes, timeWithin(*keyframes, seconds))].visible;
}

}  // namespace vlf
