#include "vlf/dynamic/reflection_probe.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr int kSteps = 24;      // of equal angle along a ray
constexpr int kBisections = 6;  // of the step in which it meets a surface
constexpr float kGap = 0.1f;    // of the distance: a longer way behind a surface is beside it
constexpr float kParallel = 1e-3f;
constexpr std::size_t kBatch = 1024;

/// Face and position on it, in texels.
struct FacePoint {
    int face;
    Vec2 at;
};

FacePoint facePoint(const Vec3& d, int size) {
    const Vec3 a = glm::abs(d);
    int face;
    Vec2 st;
    if (a.x >= a.y && a.x >= a.z)
        face = d.x < 0, st = Vec2(d.x < 0 ? d.z : -d.z, -d.y) / a.x;
    else if (a.y >= a.z)
        face = 2 + (d.y < 0), st = Vec2(d.x, d.y < 0 ? -d.z : d.z) / a.y;
    else
        face = 4 + (d.z < 0), st = Vec2(d.z < 0 ? -d.x : d.x, -d.y) / a.z;
    return {face, (0.5f * st + 0.5f) * static_cast<float>(size)};
}

/// The four texels around a direction, within its face.
struct Bilinear {
    std::array<std::size_t, 4> texel;
    std::array<float, 4> weight;

    Bilinear(const Vec3& direction, int size) {
        const FacePoint p = facePoint(direction, size);
        const Vec2 c = glm::clamp(p.at - 0.5f, Vec2(0), Vec2(static_cast<float>(size - 1)));
        const int x = static_cast<int>(c.x), y = static_cast<int>(c.y);
        const float s = c.x - static_cast<float>(x), t = c.y - static_cast<float>(y);
        const int right = std::min(x + 1, size - 1), below = std::min(y + 1, size - 1);
        const auto at = [&](int i, int j) {
            return (static_cast<std::size_t>(p.face) * size + j) * size + i;
        };
        texel = {at(x, y), at(right, y), at(x, below), at(right, below)};
        weight = {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
    }

    template <class Value>
    Value of(const std::vector<Value>& values) const {
        return weight[0] * values[texel[0]] + weight[1] * values[texel[1]] +
               weight[2] * values[texel[2]] + weight[3] * values[texel[3]];
    }
};

/// A ray as the probe's centre sees it: its points by the angle from where it starts.
class Sightline {
  public:
    Sightline(const ReflectionProbe& probe, const Vec3& origin, const Vec3& direction)
        : probe_(probe), start_(origin - probe.centre), direction_(direction) {
        const float along = glm::dot(start_, direction);
        across_ = std::sqrt(std::max(glm::dot(start_, start_) - along * along, 0.0f));
        first_ = std::atan2(along, across_);
    }

    bool passesCentre() const { return across_ <= kParallel * glm::length(start_); }

    /// Metres along the ray at fraction s in [0, 1) of all angles.
    float distance(float s) const {
        const float quarter = 0.5f * kPi;
        return across_ * (std::tan(glm::mix(first_, quarter, s)) - std::tan(first_));
    }

    /// How far a point of the ray lies behind what is seen in its direction, in units of that
    /// distance; negative before it.
    float behind(float s) const {
        const Vec3 q = start_ + distance(s) * direction_;
        const float length = glm::length(q);
        return length * Bilinear(q, probe_.size).of(probe_.inverseDistance) - 1;
    }

  private:
    const ReflectionProbe& probe_;
    Vec3 start_, direction_;
    float across_;  ///< metres from the centre to the ray's line
    float first_;   ///< angle of the start from that line's nearest point
};

ProbeView viewTowards(const ReflectionProbe& probe, const Vec3& fromCentre) {
    return {Bilinear(fromCentre, probe.size).of(probe.radiance), 0};
}

/// Fraction of the angles where the ray meets what the probe shows.
float meet(const Sightline& line) {
    constexpr float kEnd = 1 - 1e-3f;
    float in = 0;
    for (int i = 1; i <= kSteps; ++i) {
        float out = kEnd * static_cast<float>(i) / kSteps;
        const float next = out;
        if (line.behind(out) >= 0) {
            for (int k = 0; k < kBisections; ++k) {
                const float middle = 0.5f * (in + out);
                (line.behind(middle) >= 0 ? out : in) = middle;
            }
            if (line.behind(out) <= kGap) return out;
        }
        in = next;
    }
    return kEnd;
}

}  // namespace

Vec3 ReflectionProbe::direction(std::size_t texel) const {
    const std::size_t perFace = static_cast<std::size_t>(size) * size, place = texel % perFace;
    const float s = 2 * (static_cast<float>(place % size) + 0.5f) / static_cast<float>(size) - 1;
    const float t = 2 * (static_cast<float>(place / size) + 0.5f) / static_cast<float>(size) - 1;
    switch (texel / perFace) {
        case 0:
            return glm::normalize(Vec3(1, -t, -s));
        case 1:
            return glm::normalize(Vec3(-1, -t, s));
        case 2:
            return glm::normalize(Vec3(s, 1, t));
        case 3:
            return glm::normalize(Vec3(s, -1, -t));
        case 4:
            return glm::normalize(Vec3(s, -t, 1));
        default:
            return glm::normalize(Vec3(-s, -t, -1));
    }
}

void fillProbe(ReflectionProbe& probe, const Vec3& centre, int size, const ProbeSight& see) {
    probe.centre = centre;
    probe.size = size;
    probe.radiance.resize(probe.texelCount());
    probe.inverseDistance.resize(probe.texelCount());
    parallelFor((probe.texelCount() + kBatch - 1) / kBatch, [&](std::size_t batch) {
        const std::size_t first = batch * kBatch;
        const std::size_t count = std::min(kBatch, probe.texelCount() - first);
        std::array<Ray, kBatch> rays;
        std::array<float, kBatch> from;
        for (std::size_t i = 0; i < count; ++i) rays[i] = {centre, probe.direction(first + i)};
        see(std::span(rays).first(count), std::span(probe.radiance).subspan(first, count),
            std::span(from).first(count));
        for (std::size_t i = 0; i < count; ++i) probe.inverseDistance[first + i] = 1 / from[i];
    });
}

ProbeView lookUp(const ReflectionProbe& probe, const Vec3& origin, const Vec3& direction) {
    const Vec3 start = origin - probe.centre;
    const Sightline line(probe, origin, direction);
    float distance;
    if (line.passesCentre()) {
        const float inverse = Bilinear(direction, probe.size).of(probe.inverseDistance);
        distance = std::max(1 / inverse - glm::dot(start, direction), 0.0f);
        if (inverse <= 0) distance = std::numeric_limits<float>::infinity();
    } else {
        distance = line.distance(meet(line));
    }
    const Vec3 seen = std::isfinite(distance) ? start + distance * direction : direction;
    ProbeView view = viewTowards(probe, seen);
    view.distance = distance;
    return view;
}

}  // namespace vlf
