#pragma once
// From texture coordinates to texels, by wrap mode.

#include "vlf/scene/texture.h"

#include <algorithm>
#include <cmath>

namespace vlf {

/// The texel of a row of `size` that stands at place i, which may lie outside of [0, size).
inline int wrappedTexel(int i, int size, Wrap mode) {
    if (mode == Wrap::clamp) return std::clamp(i, 0, size - 1);
    const int period = mode == Wrap::mirror ? 2 * size : size;
    i %= period;
    if (i < 0) i += period;
    return i < size ? i : period - 1 - i;
}

/// Moves a coordinate near zero by whole periods, so that the conversion to int cannot overflow.
inline float reducedCoordinate(float t, Wrap mode) {
    if (mode == Wrap::clamp) return std::clamp(t, -1.0f, 2.0f);
    return t - 2 * std::floor(0.5f * t);
}

/// Where a bilinear sample lies between four texels. Row 0 is the top row; v = 0 is the bottom.
struct BilinearPlace {
    int x0, x1, y0, y1;
    float s, t;  ///< weights of x1 and y1

    BilinearPlace(const Vec2& uv, int width, int height, Wrap wrapU, Wrap wrapV) {
        const float fx = reducedCoordinate(uv.x, wrapU) * width - 0.5f;
        const float fy = (1 - reducedCoordinate(uv.y, wrapV)) * height - 0.5f;
        const int x = static_cast<int>(std::floor(fx)), y = static_cast<int>(std::floor(fy));
        s = fx - x;
        t = fy - y;
        x0 = wrappedTexel(x, width, wrapU);
        x1 = wrappedTexel(x + 1, width, wrapU);
        y0 = wrappedTexel(y, height, wrapV);
        y1 = wrappedTexel(y + 1, height, wrapV);
    }
};

}  // namespace vlf
