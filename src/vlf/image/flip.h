#pragma once
// The perceived difference of two pictures that are flipped back and forth on a display.
// [Andersson et al. 2020, FLIP: a difference evaluator for alternating images]

#include "vlf/image/metrics.h"

#include <vector>

namespace vlf {

/// What the paper assumes: a 0.7 m wide display of 3840 pixels seen from 0.7 m.
inline constexpr float kFlipPixelsPerDegree = 67;

struct FlipResult {
    double mean = 0;           ///< over the pixels of the mask
    std::vector<float> error;  ///< per pixel, row-major: 0 (equal) to 1 (as different as can be)
};

/// LDR-FLIP of display-linear images: tone-mapped to [0, 1], values outside are clamped. Pixels
/// must be finite. pixelsPerDegree is in [1, 1000]. Throws InputError.
FlipResult flip(const Image& test, const Image& reference,
                float pixelsPerDegree = kFlipPixelsPerDegree, PixelMask mask = {});

}  // namespace vlf
