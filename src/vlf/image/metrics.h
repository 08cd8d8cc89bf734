#pragma once
// How far a picture is from a reference. All sums are in double precision and in fixed order.
//
// Common to all: the images must be of equal size and finite (see nonFinitePixels); a mask, if not
// empty, has one byte per pixel and only pixels where it is not 0 count. Sizes that differ, an
// empty image or a mask that selects nothing throw InputError. Perceptual: see flip.h.

#include "vlf/image/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

using PixelMask = std::span<const std::uint8_t>;

/// mean((I - R)^2 / (R^2 + 0.01)) over pixels and channels of test I and reference R, linear. The
/// offset is in units of the image: the same weight for errors in pixels darker than about 0.1.
/// [Rousselle et al. 2011, Adaptive sampling and reconstruction using greedy error minimization]
double relativeMse(const Image& test, const Image& reference, PixelMask mask = {});

/// sqrt(sum (I - R)^2 / sum R^2) over pixels and channels, linear; independent of units. Infinite
/// where the reference is black and the test is not.
double relativeRmse(const Image& test, const Image& reference, PixelMask mask = {});

/// Peak signal-to-noise ratio in dB, -10 log10(mean (I' - R')^2) over pixels and channels, where
/// I' and R' are I and R clamped to [0, 1] and encoded to sRGB (peak value 1, no rounding to 8
/// bits). Infinite for equal images.
double peakSignalToNoise(const Image& test, const Image& reference, PixelMask mask = {});

/// Indices of pixels with a NaN or an infinity, ascending.
std::vector<std::size_t> nonFinitePixels(const Image& image);

/// The check that every metric makes first: throws InputError as described above.
void requireComparable(const Image& test, const Image& reference, PixelMask mask);

}  // namespace vlf
