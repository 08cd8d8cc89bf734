#pragma once
// How far a picture may be from a golden one.

#include "vlf/image/image.h"

#include <string>

namespace vlf::test {

/// Of two pictures in display-linear colours in [0, 1]. The first two by sRGB values.
struct PictureDifference {
    double mean = 0;   ///< mean |difference| over pixels and channels
    double share = 0;  ///< of pixels in which a channel differs by more than kVisibleStep
    double flip = 0;   ///< mean FLIP
};

inline constexpr float kVisibleStep = 8 / 255.0f;

PictureDifference difference(const Image& picture, const Image& golden);

/// Largest differences allowed, each on its own: `mean` finds a change of brightness or colour,
/// `share` a change of a few pixels (an edge, a leak, a speckle), `flip` a change of structure.
struct PictureLimits {
    std::string name;
    PictureDifference largest;
};

/// Of lines and flat colours, which hardly depend on the bake.
inline const PictureLimits kDrawing{"drawing", {0.0001, 0.0005, 0.001}};
/// Of drawings by OpenGL, where rounding and rasterisation are the driver's.
inline const PictureLimits kDrawnByGpu{"drawn by a GPU", {0.0005, 0.003, 0.002}};
/// Of baked light: ten times what rounding changes on another instruction set. One per cent more
/// light, or other samples, are beyond them.
inline const PictureLimits kBakedLight{"baked light", {0.0005, 0.002, 0.004}};

bool within(const PictureDifference& difference, const PictureLimits& limits);

/// One line: each quantity and its limit.
std::string describe(const PictureDifference& difference, const PictureLimits& limits);

}  // namespace vlf::test
