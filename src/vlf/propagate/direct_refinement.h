#pragma once
// Where direct light needs more samples: in or beside a penumbra, at a shadow's edge, close to a
// light.

#include "vlf/unwrap/unwrap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// An estimate of irradiance, W·m⁻².
struct DirectEstimate {
    Vec3 value{0};
    float variance = 0;      ///< of the luminance, if samples were independent
    float evenVariance = 0;  ///< the same as they are, spread evenly over receiver and light
    float unoccluded = 0;    ///< about the luminance if nothing stood in the way
    int samples = 0;

    /// The variance summed over the channels, which vary together.
    float squareError() const {
        const float light = luminance(value);
        const Vec3 relative = light > 0 ? value / light : Vec3(1);
        return glm::dot(relative, relative) * evenVariance;
    }

    void add(const DirectEstimate& other, float scale) {
        value += scale * other.value;
        variance += scale * scale * other.variance;
        evenVariance += scale * scale * other.evenVariance;
    }

    /// Takes an independent estimate of the same texel in.
    void merge(const DirectEstimate& other) {
        const auto all = static_cast<float>(samples + other.samples);
        const float own = static_cast<float>(samples) / all;
        value = own * value + (1 - own) * other.value;
        variance = own * own * variance + (1 - own) * (1 - own) * other.variance;
        evenVariance = own * own * evenVariance + (1 - own) * (1 - own) * other.evenVariance;
        samples += other.samples;
    }
};

/// Passes over the texels that follow the first.
inline constexpr int kRefinementPasses = 2;

/// How many samples a pass adds to the texels, by what is known of them before it.
class DirectRefinement {
  public:
    /// `estimates` of unwrap.texels, `samples` of each in the first pass; pass from 0 on.
    DirectRefinement(const Unwrap& unwrap, const std::vector<DirectEstimate>& estimates,
                     int samples, int pass);

    int samplesToAdd(std::size_t i) const;

  private:
    float wantedBeside(std::size_t i) const;
    float wanted(std::size_t i, float luminance) const;

    const Unwrap& unwrap_;
    const std::vector<DirectEstimate>& estimates_;
    int samples_, pass_;
    float target_;                        // relative standard error of a texel like the mean
    std::vector<std::uint32_t> entryOf_;  // per atlas texel
    float mean_ = 0;                      // luminance over all texels
};

/// Samples that bring the square error of the whole down to a target with the fewest of them: to
/// each texel in proportion to the spread of a sample there (J. Neyman 1934).
class DirectAllocation {
  public:
    /// `areas` of unwrap.texels, 0 where light does not count; `target`: Σ area · squareError().
    /// The estimates must outlive it.
    DirectAllocation(const Unwrap& unwrap, std::span<const float> areas,
                     const std::vector<DirectEstimate>& estimates, double target);

    int samplesToAdd(std::size_t i) const;
    /// Over all texels.
    std::uint64_t total() const;

  private:
    const std::vector<DirectEstimate>& estimates_;
    std::vector<float> wanted_;
};

}  // namespace vlf
