#include "vlf/propagate/smooth_indirect.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace {

constexpr std::size_t kBlock = 1024;

// Squared differences above so many times the noise's variance are no noise: nothing is moved.
constexpr float kCertain = 9;

// Of the step, σ being the noise of a texel: the best share of it is (σ² - cov) / (β² + variance),
// β its part that is no noise. With the kernel below cov = σ²/4 and variance = 0.64 σ².
constexpr float kGain = 0.75f / 0.64f;

/// Two texels on opposite sides of one, so that a gradient cancels; weight of each beside the
/// middle one's 4 (a binomial kernel).
struct Pair {
    int dx, dy;
    float weight;
};
constexpr std::array<Pair, 4> kPairs{{{1, 0, 2}, {0, 1, 2}, {1, 1, 1}, {1, -1, 1}}};
constexpr float kMiddle = 4;

/// What smoothing would do to a texel: the step to the neighbours' mean, and the variance of that
/// step through noise.
struct Step {
    Vec3 value{0};
    float variance = 0;

    float squared() const { return glm::dot(value, value); }
};

class Smoother {
  public:
    Smoother(const Unwrap& unwrap, const std::vector<TexelBuffer>& parts,
             const TexelBuffer& gathered)
        : unwrap_(unwrap), parts_(parts), gathered_(gathered), isTexel_(unwrap.atlasSize(), 0) {
        for (const std::uint32_t t : unwrap.texels) isTexel_[t] = 1;
    }

    Step step(std::uint32_t texel) const {
        if (gathered_.weight(texel) <= 0) return {};
        Step step{difference(gathered_, texel), 0};
        Vec3 sum(0);
        float squares = 0, count = 0;
        for (const TexelBuffer& part : parts_) {
            if (part.weight(texel) <= 0) continue;
            const Vec3 d = difference(part, texel);
            sum += d;
            squares += glm::dot(d, d);
            count += 1;
        }
        if (count < 4) return {};
        step.variance =
            std::max(0.0f, squares - glm::dot(sum, sum) / count) / (count * (count - 1));
        return step;
    }

    /// Calls visit(neighbour) for the texel's neighbours in its chart.
    template <class Visit>
    void forNeighbours(std::uint32_t texel, Visit visit) const {
        for (const Pair& p : kPairs)
            for (const std::int64_t sign : {1, -1}) {
                const std::uint32_t n = neighbour(texel, p, sign);
                if (isTexel_[n]) visit(n);
            }
    }

  private:
    // The gutter keeps all neighbours within the atlas, and other charts' texels away.
    std::uint32_t neighbour(std::uint32_t texel, const Pair& p, std::int64_t sign) const {
        return static_cast<std::uint32_t>(
            texel + sign * (p.dx + p.dy * static_cast<std::int64_t>(unwrap_.atlasWidth)));
    }

    /// Irradiance of the samples of the texel and its neighbours less its own.
    Vec3 difference(const TexelBuffer& buffer, std::uint32_t texel) const {
        Vec3 sum = kMiddle * buffer.rgb(texel);
        float samples = kMiddle * buffer.weight(texel);
        for (const Pair& p : kPairs) {
            const std::uint32_t a = neighbour(texel, p, 1), b = neighbour(texel, p, -1);
            if (!isTexel_[a] || !isTexel_[b]) continue;
            sum += p.weight * (buffer.rgb(a) + buffer.rgb(b));
            samples += p.weight * (buffer.weight(a) + buffer.weight(b));
        }
        return kPi * (sum / samples - buffer.rgb(texel) / buffer.weight(texel));
    }

    const Unwrap& unwrap_;
    const std::vector<TexelBuffer>& parts_;
    const TexelBuffer& gathered_;
    std::vector<std::uint8_t> isTexel_;
};

}  // namespace

std::vector<Vec3> smoothIndirect(const Unwrap& unwrap, const std::vector<TexelBuffer>& parts,
                                 const TexelBuffer& gathered) {
    const Smoother smoother(unwrap, parts, gathered);
    const std::size_t texels = unwrap.texels.size();
    std::vector<Step> steps(unwrap.atlasSize());
    parallelFor(texels, kBlock,
                [&](std::size_t i) { steps[unwrap.texels[i]] = smoother.step(unwrap.texels[i]); });
    std::vector<Vec3> irradiance(texels, Vec3(0));
    parallelFor(texels, kBlock, [&](std::size_t i) {
        const std::uint32_t texel = unwrap.texels[i];
        const float samples = gathered.weight(texel);
        if (samples <= 0) return;
        irradiance[i] = kPi * gathered.rgb(texel) / samples;
        const Step& own = steps[texel];
        float squared = own.squared(), variance = own.variance, count = 1;
        smoother.forNeighbours(texel, [&](std::uint32_t n) {
            squared += steps[n].squared();
            variance += steps[n].variance;
            count += 1;
        });
        if (own.squared() * count > kCertain * variance) return;
        irradiance[i] += std::min(1.0f, kGain * variance / std::max(squared, 1e-30f)) * own.value;
    });
    return irradiance;
}

}  // namespace vlf
