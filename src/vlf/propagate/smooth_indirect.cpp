#include "vlf/propagate/smooth_indirect.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace {

constexpr std::size_t kBlock = 1024;
constexpr std::array<int, 2> kStrides{1, 2};  // texels to the neighbours, pass by pass
constexpr int kMinParts = 4;                  // that a variance is reckoned from

// Squared differences above so many times the noise's variance are no noise: nothing is moved.
constexpr float kCertain = 16;

/// Two texels on opposite sides of one, so that a gradient cancels; weight of each beside the
/// middle one's 4 (a binomial kernel).
struct Pair {
    int dx, dy;
    float weight;
};
constexpr std::array<Pair, 4> kPairs{{{1, 0, 2}, {0, 1, 2}, {1, 1, 1}, {1, -1, 1}}};
constexpr float kMiddle = 4;

// Of the step, σ being the noise of a texel: the best share of it is (σ² - cov) / (β² + variance),
// β its part that is no noise. With this kernel cov = σ²/4 and variance = 0.64 σ².
constexpr float kGain = 0.75f / 0.64f;

/// What smoothing would do to a texel: the step of its mean radiance to the neighbourhood's, and
/// the variance of that step through noise.
struct Step {
    Vec3 value{0};
    float variance = 0;

    float squared() const { return glm::dot(value, value); }
};

/// One pass, with neighbours at one distance.
class Smoother {
  public:
    Smoother(const Unwrap& unwrap, const std::vector<std::uint32_t>& chartOf, int stride)
        : pitch_(unwrap.atlasWidth), chartOf_(chartOf), stride_(stride) {}

    Step step(std::span<const TexelBuffer> parts, const TexelBuffer& gathered,
              std::uint32_t texel) const {
        if (gathered.weight(texel) <= 0) return {};
        Vec3 sum(0);
        float squares = 0;
        int count = 0;
        for (const TexelBuffer& part : parts) {
            if (part.weight(texel) <= 0) continue;
            const Vec3 d = difference(part, texel);
            sum += d;
            squares += glm::dot(d, d);
            ++count;
        }
        if (count < kMinParts) return {};
        const auto n = static_cast<float>(count);
        const float spread = std::max(0.0f, squares - glm::dot(sum, sum) / n);
        return {difference(gathered, texel), spread / (n * (n - 1))};
    }

    /// The share of its step that a texel is to take.
    float share(const std::vector<Step>& steps, std::uint32_t texel) const {
        const Step& own = steps[texel];
        float squared = own.squared(), variance = own.variance, count = 1;
        for (const Pair& p : kPairs)
            for (const int sign : {1, -1})
                if (const std::uint32_t n = neighbour(texel, p, sign); n != kNone) {
                    squared += steps[n].squared();
                    variance += steps[n].variance;
                    count += 1;
                }
        if (own.squared() * count > kCertain * variance || squared <= 0) return 0;
        return std::min(1.0f, kGain * variance / squared);
    }

    /// Mean radiance of the samples of the texel and its neighbours less that of its own.
    Vec3 difference(const TexelBuffer& buffer, std::uint32_t texel) const {
        Vec3 sum = kMiddle * buffer.rgb(texel);
        float samples = kMiddle * buffer.weight(texel);
        for (const Pair& p : kPairs) {
            const std::uint32_t a = neighbour(texel, p, 1), b = neighbour(texel, p, -1);
            if (a == kNone || b == kNone) continue;
            sum += p.weight * (buffer.rgb(a) + buffer.rgb(b));
            samples += p.weight * (buffer.weight(a) + buffer.weight(b));
        }
        return sum / samples - buffer.rgb(texel) / buffer.weight(texel);
    }

  private:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    /// The neighbour, if the chart reaches there without a gap.
    std::uint32_t neighbour(std::uint32_t texel, const Pair& p, int sign) const {
        const std::int64_t step = sign * (p.dx + p.dy * pitch_);
        std::int64_t n = texel;
        for (int i = 0; i < stride_; ++i) {
            n += step;
            if (chartOf_[static_cast<std::size_t>(n)] != chartOf_[texel]) return kNone;
        }
        return static_cast<std::uint32_t>(n);
    }

    std::int64_t pitch_;
    const std::vector<std::uint32_t>& chartOf_;
    int stride_;
};

/// Adds what a texel's samples change by if their mean does by `change`.
void add(TexelBuffer& buffer, std::uint32_t texel, const Vec3& change) {
    buffer.add(texel, buffer.weight(texel) * change, 0);
}

}  // namespace

void smoothIndirect(const Unwrap& unwrap, std::span<TexelBuffer> parts, TexelBuffer& gathered) {
    const std::vector<std::uint32_t>& texels = unwrap.texels;
    std::vector<std::uint32_t> chartOf(unwrap.atlasSize(), kNoChart);
    for (std::size_t i = 0; i < texels.size(); ++i) chartOf[texels[i]] = unwrap.texelChart[i];
    std::vector<Step> steps(unwrap.atlasSize());
    std::vector<float> shares(texels.size());
    for (const int stride : kStrides) {
        const Smoother smoother(unwrap, chartOf, stride);
        parallelFor(texels.size(), kBlock, [&](std::size_t i) {
            steps[texels[i]] = smoother.step(parts, gathered, texels[i]);
        });
        parallelFor(texels.size(), kBlock,
                    [&](std::size_t i) { shares[i] = smoother.share(steps, texels[i]); });
        parallelFor(parts.size(), [&](std::size_t part) {
            const TexelBuffer before = parts[part];
            for (std::size_t i = 0; i < texels.size(); ++i)
                if (shares[i] > 0 && before.weight(texels[i]) > 0)
                    add(parts[part], texels[i], shares[i] * smoother.difference(before, texels[i]));
        });
        for (std::size_t i = 0; i < texels.size(); ++i)
            if (shares[i] > 0) add(gathered, texels[i], shares[i] * steps[texels[i]].value);
    }
}

}  // namespace vlf
