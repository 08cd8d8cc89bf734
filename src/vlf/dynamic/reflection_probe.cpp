#include "vlf/dynamic/reflection_probe.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr int kSteps = 24;       // of equal angle along a ray
constexpr int kRefinements = 6;  // of the step in which it meets a surface
constexpr float kGap = 0.1f;     // of the distance: a longer way behind a surface is beside it
constexpr float kInfinity = std::numeric_limits<float>::infinity();
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

/// A ray as the probe's centre sees it.
class Sightline {
  public:
    Sightline(const ReflectionProbe& probe, const Vec3& origin, const Vec3& direction)
        : probe_(probe), start_(origin - probe.centre), direction_(direction) {
        const float along = glm::dot(start_, direction);
        across_ = std::sqrt(std::max(glm::dot(start_, start_) - along * along, 0.0f));
        first_ = std::atan2(along, across_);
        end_ = glm::length(start_) + 1.01f * probe.farthest;
    }

    /// Metres along the ray at fraction s in [0, 1] of all angles, at most to where nothing is.
    float distance(float s) const {
        const float angle = glm::mix(first_, 0.5f * kPi, s);
        if (s >= 1 || std::cos(angle) * end_ <= across_) return end_;
        return std::min(across_ * (std::tan(angle) - std::tan(first_)), end_);
    }

    Vec3 fromCentre(float t) const { return start_ + t * direction_; }

    /// How far the point at t lies behind what is seen in its direction, in units of that distance;
    /// negative before it.
    float behind(float t) const {
        const Vec3 q = fromCentre(t);
        const float length = glm::length(q);
        if (length <= 0) return -1;
        return length * Bilinear(q, probe_.size).of(probe_.inverseDistance) - 1;
    }

  private:
    const ReflectionProbe& probe_;
    Vec3 start_, direction_;
    float across_;  ///< metres from the centre to the ray's line
    float first_;   ///< angle of the start from that line's nearest point
    float end_;
};

/// Where between `in`, before the surface, and `out`, behind it, the ray meets it.
float refine(const Sightline& line, float in, float before, float out, float behind) {
    for (int k = 0; k < kRefinements && behind > 0; ++k) {
        const float t = glm::mix(in, out, before / (before - behind));
        const float here = line.behind(t);
        if (here >= 0)
            out = t, behind = here, before *= 0.5f;
        else
            in = t, before = here, behind *= 0.5f;
    }
    return out;
}

/// Metres along the ray to what the probe shows.
float meet(const Sightline& line) {
    float in = 0, before = line.behind(0);
    for (int i = 1; i <= kSteps; ++i) {
        const float out = line.distance(static_cast<float>(i) / kSteps);
        const float behind = line.behind(out);
        if (before < 0 && behind >= 0) {
            const float t = refine(line, in, before, out, behind);
            if (i == kSteps || line.behind(t) <= kGap) return t;
        }
        in = out, before = behind;
    }
    return before < 0 ? kInfinity : in;
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
    probe.farthest = 0;
    for (const float inverse : probe.inverseDistance)
        if (inverse > 0) probe.farthest = std::max(probe.farthest, 1 / inverse);
}

ProbeView lookUp(const ReflectionProbe& probe, const Vec3& origin, const Vec3& direction) {
    const Sightline line(probe, origin, direction);
    ProbeView view;
    view.distance = meet(line);
    const Vec3 seen = std::isfinite(view.distance) ? line.fromCentre(view.distance) : direction;
    view.radiance = Bilinear(seen, probe.size).of(probe.radiance);
    return view;
}

}  // namespace vlf
