#include "vlf/propagate/indirect_noise.h"

#include "vlf/base/parallel.h"
#include "vlf/math/vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vlf {

namespace {

constexpr std::size_t kBlock = 1024;

// Square errors (arbitrary units) of 513 lines with 0.26 samples of a texel each, by directions and
// by samples: of the whole set, and as the spread of the parts tells it. The former fall with
// l^(-3/2), the latter with the number of samples. Measured in cornell and mirror-room.
constexpr double kWhole = 0.115, kWholeTurned = 0.02, kWholeSamples = 0.57;
constexpr double kParts = 1.66, kPartsSamples = 0.33;
constexpr int kMinParts = 4;       // that a variance is reckoned from
constexpr float kOwnShare = 0.1f;  // of all samples; of fewer rays of its own the spread tells

struct Spread {
    float variance = 0;  // of the mean radiance
    bool known = false;
};

/// Of the mean of the parts' samples, taken as one sample each of its weight.
Spread spreadOf(std::span<const TexelBuffer> parts, const TexelBuffer& gathered,
                std::uint32_t texel) {
    Vec3 sum(0);
    float weight = 0;
    int count = 0;
    for (const TexelBuffer& part : parts) {
        if (part.weight(texel) <= 0) continue;
        sum += part.rgb(texel);
        weight += part.weight(texel);
        ++count;
    }
    const float all = gathered.weight(texel);
    if (count < kMinParts || all - weight > kOwnShare * all) return {};
    const Vec3 mean = sum / weight;
    float squares = 0;
    for (const TexelBuffer& part : parts) {
        const float w = part.weight(texel);
        if (w <= 0) continue;
        const Vec3 d = part.rgb(texel) - w * mean;
        squares += glm::dot(d, d);
    }
    const auto n = static_cast<float>(count);
    return {squares / (weight * weight) * n / (n - 1), true};
}

/// Variance of what all directions gather to that of its parts if these were independent.
float evennessOf(const SweptDirections& swept, double samplesPerLine) {
    const double samples = 0.26 / std::max(samplesPerLine, 1e-6);
    const double whole =
        (swept.turned ? kWholeTurned : kWhole) * swept.spacing + kWholeSamples * samples;
    const double parts = kParts * swept.spacing + kPartsSamples * samples;
    return static_cast<float>(std::min(1.0, whole / parts));
}

}  // namespace

std::vector<float> indirectVariance(const Unwrap& unwrap, std::span<const TexelBuffer> parts,
                                    const TexelBuffer& gathered, const SweptDirections& swept) {
    const std::vector<std::uint32_t>& texels = unwrap.texels;
    std::vector<Spread> spread(texels.size());
    parallelFor(texels.size(), kBlock,
                [&](std::size_t i) { spread[i] = spreadOf(parts, gathered, texels[i]); });
    const auto squaredMean = [&](std::uint32_t texel) {
        const Vec3 mean = gathered.rgb(texel) / gathered.weight(texel);
        return glm::dot(mean, mean);
    };
    // Of one sample, to the square of what it is a sample of.
    double variance = 0, squares = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (!spread[i].known) continue;
        variance += double{spread[i].variance} * gathered.weight(texels[i]);
        squares += squaredMean(texels[i]);
    }
    const auto ofSample = static_cast<float>(squares > 0 ? variance / squares : 1);
    std::vector<float> result(texels.size(), 0);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const float samples = gathered.weight(texels[i]);
        if (samples <= 0) continue;
        const float v =
            spread[i].known ? spread[i].variance : ofSample * squaredMean(texels[i]) / samples;
        result[i] = kPi * kPi * evennessOf(swept, samples / swept.lines) * v;
    }
    return result;
}

}  // namespace vlf
