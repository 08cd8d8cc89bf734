#pragma once
// Separable filters on single-channel images. Beyond its border an image continues with the
// value of the border.

#include "vlf/base/parallel.h"

#include <cstddef>
#include <vector>

namespace vlf {

/// One channel, row-major.
struct Plane {
    int width = 0, height = 0;
    std::vector<float> values;

    Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * h) {}
};

/// Weights of the offsets -r .. r, 2 r + 1 of them.
using Kernel = std::vector<float>;

/// weight(i) for i = -radius .. radius.
template <class Weight>
Kernel makeKernel(int radius, Weight weight) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(static_cast<float>(i)));
    return kernel;
}

/// Divides by the sum, which is returned.
float normalize(Kernel& kernel);

/// Scales the positive weights to a sum of 1 and the negative ones to a sum of -1.
void normalizeSigns(Kernel& kernel);

/// sum_i kernel[i] plane(x + i, y).
Plane filterRows(const Plane& plane, const Kernel& kernel);

/// sum_i kernel[i] plane(x, y + i).
Plane filterColumns(const Plane& plane, const Kernel& kernel);

}  // namespace vlf
