#include "vlf/image/convolution.h"

#include <algorithm>
#include <numeric>

namespace vlf {

namespace {

/// out[x] += weight * in[x]
void addScaled(float* out, const float* in, float weight, int count) {
    for (int x = 0; x < count; ++x) out[x] += weight * in[x];
}

std::vector<float> paddedRow(const float* row, int width, int radius) {
    std::vector<float> padded(static_cast<std::size_t>(width) + 2 * radius);
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + radius);
    std::fill_n(padded.end() - radius, radius, row[width - 1]);
    return padded;
}

}  // namespace

float normalize(Kernel& kernel) {
    const float sum = std::accumulate(kernel.begin(), kernel.end(), 0.0f);
    for (float& w : kernel) w /= sum;
    return sum;
}

void normalizeSigns(Kernel& kernel) {
    float positive = 0, negative = 0;
    for (const float w : kernel) (w > 0 ? positive : negative) += w;
    for (float& w : kernel) w /= w > 0 ? positive : -negative;
}

Plane filterRows(const Plane& plane, const Kernel& kernel) {
    Plane result(plane.width, plane.height);
    const int radius = static_cast<int>(kernel.size()) / 2;
    parallelFor(plane.height, 8, [&](std::size_t y) {
        const std::vector<float> in =
            paddedRow(&plane.values[y * plane.width], plane.width, radius);
        float* out = &result.values[y * plane.width];
        for (std::size_t i = 0; i < kernel.size(); ++i)
            addScaled(out, &in[i], kernel[i], plane.width);
    });
    return result;
}

Plane filterColumns(const Plane& plane, const Kernel& kernel) {
    Plane result(plane.width, plane.height);
    const int radius = static_cast<int>(kernel.size()) / 2;
    parallelFor(plane.height, 8, [&](std::size_t y) {
        float* out = &result.values[y * plane.width];
        for (int i = -radius; i <= radius; ++i) {
            const int row = std::clamp(static_cast<int>(y) + i, 0, plane.height - 1);
            addScaled(out, &plane.values[static_cast<std::size_t>(row) * plane.width],
                      kernel[i + radius], plane.width);
        }
    });
    return result;
}

}  // namespace vlf
