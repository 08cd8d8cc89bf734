// Which lights matter where: how LightGatherer shares its samples out.

#include "vlf/propagate/light_gatherer.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr std::size_t kCrowd = 64;   // lights; of more, those share samples that have less than
constexpr float kApart = 1.0f / 16;  // this share of the effect

}  // namespace

void LightGatherer::weighTogether(std::span<const LightReceiver> receivers) {
    shared_.reset();
    if (sources_.lights.size() <= kCrowd || receivers.size() < 2) return;
    LightReceiver all = receivers[0];
    all.centre = Vec3(0);
    for (const LightReceiver& r : receivers)
        all.centre += r.centre / static_cast<float>(receivers.size());
    for (const LightReceiver& r : receivers)
        all.radius = std::max(all.radius, glm::distance(all.centre, r.centre) + r.radius);
    weigh(all, shared_.emplace());
}

/// Lights of some effect get a few samples whatever the others: those may be hidden. Where there
/// are many, all but the strongest share theirs.
void LightGatherer::weigh(const LightReceiver& receiver, Weights& weights) const {
    weights.clear();
    for (std::size_t i = 0; i < sources_.images.size(); ++i) {
        const bool counts = counted_.empty() || counted_[i] != 0;
        weights.effects.push_back(counts ? likelyEffect(receiver, sources_.images[i]) : 0.0f);
        weights.sum += weights.effects.back();
    }
    const float enough = sources_.lights.size() > kCrowd ? kApart * weights.sum : 0;
    float rest = 0;
    for (std::uint32_t i = 0; i < weights.effects.size(); ++i) {
        if (weights.effects[i] <= 0) continue;
        if (weights.effects[i] >= enough) {
            weights.apart.push_back(i);
        } else {
            weights.together.push_back(i);
            weights.upTo.push_back(rest += weights.effects[i]);
        }
    }
}

float LightGatherer::likelyEffect(const LightReceiver& r, const LightImage& image) const {
    const Light& light = sources_.lights[image.light];
    if (light.kind == LightKind::punctual) return likelyPunctual(r, image);
    if (light.kind == LightKind::sky) return likelySky(r, image);
    const Vec3 toLight = image.imageFromWorld.point(light.centre) - r.centre;
    const float reach = light.radius + r.radius;
    const float squared = std::max(glm::dot(toLight, toLight), 0.25f * reach * reach);
    const float distance = std::sqrt(squared), slack = std::min(1.0f, reach / distance);
    if (r.planar && glm::dot(r.normal, toLight) < -reach) return 0;
    const float cosReceiver = glm::dot(r.normal, toLight) / distance;
    const float cosLight = -glm::dot(image.imageFromWorld.vector(light.normal), toLight) / distance;
    const float spread =
        light.planar ? 0.0f : std::acos(std::clamp(light.normalCosine, -1.0f, 1.0f));
    if (light.planar && cosLight < -slack) return 0;
    if (image.depth > 0 && !mayBeSeenInMirror(r, image)) return 0;
    const float facing = std::clamp(cosReceiver + 0.5f * slack, 0.02f, 1.0f);
    const float emitting = std::clamp(cosLight + 0.5f * slack + spread, 0.02f, 1.0f);
    return luminance(light.radiance * image.throughput) * light.area * facing * emitting / squared;
}

bool mayBeSeenIn(const Chart& mirror, float offset, const Sphere& receiver, const Sphere& image) {
    const float before = glm::dot(mirror.normal, receiver.centre) - offset;
    const float behind = offset - glm::dot(mirror.normal, image.centre);
    if (before < -receiver.radius || behind < -image.radius) return false;
    const float share = std::max(before, 0.0f) / std::max(before + behind, 1e-20f);
    const Vec2 crossing =
        mirror.texelCoordinates(receiver.centre + share * (image.centre - receiver.centre));
    // How far the crossing moves as the ends move within their spheres, seen aslant.
    const float cosine =
        std::max(before + behind, 1e-20f) / glm::distance(image.centre, receiver.centre);
    const float reach = (share * image.radius + (1 - share) * receiver.radius) / cosine;
    const Vec2 margin(reach * glm::length(mirror.uAxis), reach * glm::length(mirror.vAxis));
    return crossing.x > -margin.x && crossing.x < mirror.width + margin.x &&
           crossing.y > -margin.y && crossing.y < mirror.height + margin.y;
}

/// By the first mirror.
bool LightGatherer::mayBeSeenInMirror(const LightReceiver& r, const LightImage& image) const {
    const Light& light = sources_.lights[image.light];
    return mayBeSeenIn(unwrap_.charts[image.mirror[0]], sources_.mirrorOffset[image.mirror[0]],
                       {r.centre, r.radius},
                       {image.imageFromWorld.point(light.centre), light.radius});
}

}  // namespace vlf
