#pragma once
// Where direct light needs more samples: in or beside a penumbra, at a shadow's edge, close to a
// light.

#include "vlf/unwrap/unwrap.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// An estimate of irradiance, W·m⁻².
struct DirectEstimate {
    Vec3 value{0};
    float variance = 0;    ///< of the luminance
    float unoccluded = 0;  ///< about the luminance if nothing stood in the way
    int samples = 0;

    void add(const DirectEstimate& other, float scale) {
        value += scale * other.value;
        variance += scale * scale * other.variance;
    }

    /// Takes an independent estimate of the same texel in.
    void merge(const DirectEstimate& other) {
        const auto all = static_cast<float>(samples + other.samples);
        const float own = static_cast<float>(samples) / all;
        value = own * value + (1 - own) * other.value;
        variance = own * own * variance + (1 - own) * (1 - own) * other.variance;
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

}  // namespace vlf
