#include "vlf/propagate/direct_refinement.h"

#include "vlf/propagate/texel_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

// Passes go over texels in or beside a penumbra or close to a light: towards a standard error
// of kTarget / √samples (relative to the texel's light and the room's; less where it is brighter
// than the mean, so that no texel has more than its share of the whole error), by at least
// kRefinement times the samples of the first pass and no more than the pass allows.
constexpr float kTarget = 0.065f, kRefineAbove = 0.004f;
constexpr int kRefinement = 6;
constexpr std::array<int, kRefinementPasses> kMaxRefinement{48, 1024};
constexpr float kWorthwhile = 0.25f;   // fewer more samples than this share do not matter
constexpr float kFewestAdded = 0.02f;  // likewise, of an allocation
constexpr float kMostGrowth = 16;      // of a texel's samples in one pass of an allocation
constexpr float kBright = 8;           // times the mean
constexpr float kRoomShare = 0.3f;
constexpr float kShadowEdge = 0.25f;  // relative step between neighbours that counts as an edge

constexpr std::uint32_t kNone = 0xffffffffu;

}  // namespace

DirectRefinement::DirectRefinement(const Unwrap& unwrap,
                                   const std::vector<DirectEstimate>& estimates, int samples,
                                   int pass)
    : unwrap_(unwrap),
      estimates_(estimates),
      samples_(samples),
      pass_(pass),
      target_(kTarget / std::sqrt(static_cast<float>(samples))),
      entryOf_(unwrap.atlasSize(), kNone) {
    double sum = 0;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        entryOf_[unwrap.texels[i]] = static_cast<std::uint32_t>(i);
        sum += luminance(estimates[i].value);
    }
    mean_ = static_cast<float>(sum / static_cast<double>(estimates.size()));
}

int DirectRefinement::samplesToAdd(std::size_t i) const {
    const DirectEstimate& e = estimates_[i];
    const float wanted = pass_ == 0 ? wantedBeside(i) : this->wanted(i, luminance(e.value));
    if (wanted <= 0) return 0;
    const float missing = wanted - static_cast<float>(e.samples);
    const bool isFirst = e.samples == samples_;
    if (!isFirst && missing < kWorthwhile * static_cast<float>(e.samples)) return 0;
    const int least = isFirst ? kRefinement * samples_ : 1;
    return static_cast<int>(std::clamp<float>(missing, least, kMaxRefinement[pass_] * samples_));
}

/// Samples for the texel's error and its neighbours': edges reach into them.
float DirectRefinement::wantedBeside(std::size_t i) const {
    const auto texel = static_cast<std::int64_t>(unwrap_.texels[i]);
    const auto pitch = static_cast<std::int64_t>(unwrap_.atlasWidth);
    const float own = luminance(estimates_[i].value);
    bool edge = false;
    float most = 0;
    // The gutter keeps all neighbours within the atlas.
    for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            const std::uint32_t n = entryOf_[texel + dy * pitch + dx];
            if (n == kNone) continue;
            const float other = luminance(estimates_[n].value), brighter = std::max(own, other);
            most = std::max(most, wanted(n, brighter));
            edge = edge || std::abs(other - own) > kShadowEdge * (brighter + kRoomShare * mean_);
        }
    return edge ? std::max(most, 1.0f) : most;
}

/// Samples for the error of entry i beside light of the given luminance.
float DirectRefinement::wanted(std::size_t i, float luminance) const {
    const DirectEstimate& e = estimates_[i];
    const float light = luminance + kRoomShare * mean_;
    // What one more sample might change where all so far agree.
    const float unknown = e.unoccluded / static_cast<float>(e.samples + 1);
    const float risk = unknown > kBright * light ? unknown : 0;
    const float error = std::max(std::sqrt(e.variance), risk) / light;
    if (!(error >= kRefineAbove)) return 0;
    const float target = target_ / std::sqrt(std::max(1.0f, light / (kBright * mean_)));
    return static_cast<float>(e.samples) * error * error / (target * target);
}

DirectAllocation::DirectAllocation(const Unwrap& unwrap, std::span<const float> areas,
                                   const std::vector<DirectEstimate>& estimates, double target)
    : estimates_(estimates), wanted_(estimates.size(), 0) {
    const TexelNeighbours neighbours(unwrap);
    // Of a sample, with the texels beside: few samples do not tell their own spread.
    const auto spread = [&](std::size_t i) {
        float sum = 0, count = 0;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const std::uint32_t n = neighbours.beside(i, dx, dy);
                    n != TexelNeighbours::kNone) {
                    sum += estimates[n].squareError() * static_cast<float>(estimates[n].samples);
                    count += 1;
                }
        return std::sqrt(sum / count);
    };
    double sum = 0;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        if (areas[i] <= 0) continue;
        wanted_[i] = spread(i) * std::sqrt(areas[i]);
        sum += wanted_[i];
    }
    const auto scale = static_cast<float>(sum / target);
    for (float& wanted : wanted_) wanted *= scale;
}

int DirectAllocation::samplesToAdd(std::size_t i) const {
    const auto own = static_cast<float>(estimates_[i].samples);
    const float missing = std::min(wanted_[i], kMostGrowth * own) - own;
    return missing > kFewestAdded * own ? static_cast<int>(std::ceil(missing)) : 0;
}

std::uint64_t DirectAllocation::total() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < wanted_.size(); ++i)
        sum += static_cast<std::uint64_t>(samplesToAdd(i));
    return sum;
}

}  // namespace vlf
