#pragma once
// From scene radiance to what a display can show.

#include "vlf/image/image.h"

namespace vlf {

enum class ToneCurve {
    clamp,   ///< values above 1 are cut; for comparing, since everything below is kept as it is
    filmic,  ///< soft shoulder and toe after ACES; for looking at
};

/// Display-linear colour in [0, 1] of a scene-linear one. Every curve is monotone per channel,
/// maps 0 to 0, and negative values and NaN to 0.
Vec3 toneMap(const Vec3& color, ToneCurve curve);

/// The image multiplied by 2^exposure, then tone-mapped: ready for writePng.
Image toneMap(const Image& image, float exposure, ToneCurve curve);

/// Exposure in EV that brings the log-average luminance of the image to middle grey, 0.18
/// [Reinhard et al. 2002, Photographic tone reproduction, eq. 1]. Pixels that are black (under
/// 1/10000 of the mean) or not finite do not count; 0 for an image of nothing else.
float autoExposure(const Image& image);

}  // namespace vlf
