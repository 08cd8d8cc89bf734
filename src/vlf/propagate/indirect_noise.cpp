#include "vlf/propagate/indirect_noise.h"

#include "vlf/base/parallel.h"
#include "vlf/math/vector.h"
#include "vlf/propagate/bake_solution.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace vlf {

namespace {

constexpr std::size_t kBlock = 1024;
constexpr int kMinParts = 4;       // that a variance is reckoned from
constexpr float kOwnShare = 0.1f;  // of all samples; of fewer rays of its own the parts tell

// What turned sets have of it: measured, 0.3 to 0.7 in six rooms.
constexpr float kTurned = 0.5f;

/// What the parts of a texel tell of the variance of its mean radiance.
struct PartSpread {
    float independent = 0;  // if they were independent
    float fine = 0;         // as they are
    bool known = false;
};

using Deviations = std::array<Vec3, kAccumulators>;

/// Cosine and sine of the k-th wave of a discrete Fourier transform over the parts.
using Wave = std::array<Vec2, kAccumulators>;

Wave waveOf(int k) {
    Wave wave;
    for (std::size_t a = 0; a < wave.size(); ++a) {
        const float angle = 2 * kPi * static_cast<float>(k * a) / static_cast<float>(wave.size());
        wave[a] = {std::cos(angle), std::sin(angle)};
    }
    return wave;
}

/// Squared magnitude of the wave's coefficient.
float power(const Deviations& deviations, const Wave& wave) {
    Vec3 re(0), im(0);
    for (std::size_t a = 0; a < wave.size(); ++a) {
        re += wave[a].x * deviations[a];
        im += wave[a].y * deviations[a];
    }
    return glm::dot(re, re) + glm::dot(im, im);
}

/// The mean of their samples is taken as one sample of each part, of its weight. White noise has as
/// much power at every frequency, each of which estimates the variance of the sum; the highest
/// three, 3/8, 4/8 and 5/8 per line, have little else.
PartSpread spreadOf(std::span<const TexelBuffer> parts, const TexelBuffer& gathered,
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
    Deviations deviations;
    float squares = 0;
    for (std::size_t a = 0; a < kAccumulators; ++a) {
        deviations[a] = (parts[a].rgb(texel) - parts[a].weight(texel) * mean) / weight;
        squares += glm::dot(deviations[a], deviations[a]);
    }
    static const Wave third = waveOf(3), fourth = waveOf(4);  // the fifth has the third's power
    const auto n = static_cast<float>(count);
    return {squares * n / (n - 1), (2 * power(deviations, third) + power(deviations, fourth)) / 3,
            true};
}

}  // namespace

std::vector<float> indirectVariance(const Unwrap& unwrap, std::span<const TexelBuffer> parts,
                                    const TexelBuffer& gathered, bool turned) {
    const std::vector<std::uint32_t>& texels = unwrap.texels;
    std::vector<PartSpread> spread(texels.size());
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
        variance += double{spread[i].independent} * gathered.weight(texels[i]);
        squares += squaredMean(texels[i]);
    }
    const auto ofSample = static_cast<float>(squares > 0 ? variance / squares : 1);
    std::vector<float> result(texels.size(), 0);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const float samples = gathered.weight(texels[i]);
        if (samples <= 0) continue;
        const float v = spread[i].known ? (turned ? kTurned : 1) * spread[i].fine
                                        : ofSample * squaredMean(texels[i]) / samples;
        result[i] = kPi * kPi * v;
    }
    return result;
}

}  // namespace vlf
