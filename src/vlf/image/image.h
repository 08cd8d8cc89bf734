#pragma once
// A picture in linear radiance or any other per-pixel RGB quantity.

#include "vlf/math/vector.h"

#include <cstddef>
#include <vector>

namespace vlf {

/// Row-major RGB floats, row 0 at the top.
struct Image {
    int width = 0, height = 0;
    std::vector<Vec3> pixels;

    Image() = default;
    Image(int w, int h, const Vec3& fill = Vec3(0))
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}

    Vec3& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
    const Vec3& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

}  // namespace vlf
