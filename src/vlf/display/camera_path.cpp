#include "vlf/display/camera_path.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vlf {

namespace {

constexpr double kLongestSeconds = 86400;
constexpr double kLeastStep = 1e-6;      // seconds between samples
constexpr float kFarthestMetres = 1e6f;  // from the origin

constexpr double kRestSeconds = 1;          // of a tour at each camera
constexpr double kMetresPerSecond = 0.8;    // a stroll; at its fastest half as much again
constexpr double kRadiansPerSecond = 0.5;   // 30 degrees a second
constexpr double kShortestMoveSeconds = 1;  // between two cameras

/// Radians from one yaw to another by the short way.
double turn(double from, double to) {
    return std::remainder(to - from, 2 * std::numbers::pi);
}

void requirePose(const CameraPose& pose, const SourceLocation& where) {
    if (!(maxComponent(glm::abs(pose.eye)) <= kFarthestMetres) || !isFinite(pose.eye))
        throw InputError(where, "the eye must be numbers within 1000 km of the origin");
    if (!std::isfinite(pose.yaw)) throw InputError(where, "yaw must be finite");
    if (!(std::abs(pose.pitch) <= CameraPose::kMostPitch))
        throw InputError(where, fmt::format("pitch must lie within {:.1f} degrees of level",
                                            CameraPose::kMostPitch * 180 / std::numbers::pi));
    if (!(pose.verticalFov > 0 && pose.verticalFov < 180))
        throw InputError(where, "the field of view must lie between 0 and 180 degrees");
}

void requireSamples(const std::vector<CameraSample>& samples, const std::string& name) {
    if (samples.empty()) throw InputError({name, 0, "camera"}, "must hold at least one sample");
    double before = -1;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const SourceLocation where{name, 0, fmt::format("camera[{}]", i)};
        const double seconds = samples[i].seconds;
        if (!(seconds >= 0 && seconds <= kLongestSeconds))
            throw InputError(where, "the time must be a number of seconds between 0 and a day");
        if (!(seconds - before >= kLeastStep))
            throw InputError(where,
                             fmt::format("times must increase by a microsecond or more: {} s "
                                         "follows {} s",
                                         seconds, before));
        before = seconds;
        requirePose(samples[i].pose, where);
    }
}

/// Slope of a monotone curve between chords of slopes `left` and `right` over `leftLength` and
/// `rightLength`: their weighted harmonic mean, 0 at a turning point (eq. 5 of the paper).
double monotoneSlope(double left, double right, double leftLength, double rightLength) {
    if (left == 0 || right == 0 || (left > 0) != (right > 0)) return 0;
    const double weight = (leftLength + 2 * rightLength) / (3 * (leftLength + rightLength));
    return 1 / (weight / left + (1 - weight) / right);
}

/// Cubic Hermite curve over [0, length] at fraction u.
double hermite(double from, double to, double fromSlope, double toSlope, double length, double u) {
    const double rest = 1 - u;
    return from * rest * rest * (1 + 2 * u) + to * u * u * (3 - 2 * u) +
           length * u * rest * (fromSlope * rest - toSlope * u);
}

}  // namespace

CameraPath::CameraPath(std::vector<CameraSample> samples, const std::string& nameForErrors)
    : samples_(std::move(samples)) {
    requireSamples(samples_, nameForErrors);
    double yaw = samples_.front().pose.yaw;
    for (const CameraSample& sample : samples_) {
        const CameraPose& p = sample.pose;
        yaw += turn(yaw, p.yaw);
        values_.push_back({p.eye.x, p.eye.y, p.eye.z, yaw, p.pitch, p.verticalFov});
    }
    slopes_.assign(values_.size(), {});
    const auto length = [&](std::size_t i) {
        return samples_[i + 1].seconds - samples_[i].seconds;
    };
    const auto chord = [&](std::size_t i, int curve) {
        return (values_[i + 1][curve] - values_[i][curve]) / length(i);
    };
    // At rest at both ends.
    for (std::size_t i = 1; i + 1 < values_.size(); ++i)
        for (int curve = 0; curve < kCurves; ++curve)
            slopes_[i][curve] =
                monotoneSlope(chord(i - 1, curve), chord(i, curve), length(i - 1), length(i));
}

CameraPose CameraPath::at(double seconds) const {
    const auto after =
        std::upper_bound(samples_.begin(), samples_.end(), seconds,
                         [](double t, const CameraSample& s) { return t < s.seconds; });
    if (after == samples_.begin()) return samples_.front().pose;
    if (after == samples_.end()) return samples_.back().pose;
    const auto i = static_cast<std::size_t>(after - samples_.begin());
    const double start = samples_[i - 1].seconds, length = samples_[i].seconds - start;
    const auto value = [&](int curve) {
        return static_cast<float>(hermite(values_[i - 1][curve], values_[i][curve],
                                          slopes_[i - 1][curve], slopes_[i][curve], length,
                                          (seconds - start) / length));
    };
    return {{value(0), value(1), value(2)}, value(3), value(4), value(5)};
}

void PathRecorder::record(double seconds, const CameraPose& pose) {
    const std::size_t n = samples_.size();
    const bool rests = n >= 2 && samples_[n - 2].pose == pose && samples_[n - 1].pose == pose;
    const bool replaces = n >= 1 && seconds - samples_[n - 1].seconds < kLeastStep;
    if (replaces)
        samples_.back().pose = pose;
    else if (rests)
        samples_.back().seconds = seconds;
    else
        samples_.push_back({seconds, pose});
}

void PathRecorder::jump(double seconds, const CameraPose& pose) {
    if (!empty()) record(seconds - 2 * kLeastStep, samples_.back().pose);
    record(seconds, pose);
}

CameraPath tour(std::span<const Camera> cameras) {
    if (cameras.size() < 2)
        throw InputError(
            fmt::format("a tour needs two cameras or more, the scene has {}; write a "
                        "camera path and give it with --path",
                        cameras.size()));
    std::vector<CameraSample> samples;
    double seconds = 0;
    for (const Camera& camera : cameras) {
        const CameraPose pose = poseOf(camera);
        if (!samples.empty()) {
            const CameraPose& last = samples.back().pose;
            seconds += std::max({glm::distance(last.eye, pose.eye) / kMetresPerSecond,
                                 std::abs(turn(last.yaw, pose.yaw)) / kRadiansPerSecond,
                                 std::abs(pose.pitch - last.pitch) / kRadiansPerSecond,
                                 kShortestMoveSeconds});
        }
        samples.push_back({seconds, pose});
        seconds += kRestSeconds;
        samples.push_back({seconds, pose});
    }
    return CameraPath(std::move(samples), "tour");
}

}  // namespace vlf
