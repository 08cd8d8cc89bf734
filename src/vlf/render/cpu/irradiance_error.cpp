#include "vlf/render/cpu/irradiance_error.h"

#include <algorithm>
#include <cmath>

namespace vlf {

IrradianceError compareIrradiance(std::span<const Vec3> baked,
                                  std::span<const IrradianceEstimate> reference,
                                  std::span<const float> area) {
    IrradianceError result;
    double squares = 0, truth = 0, truthSquares = 0, variance = 0, difference = 0;
    double differenceVariance = 0, relative = 0, areaSum = 0;
    for (std::size_t i = 0; i < baked.size(); ++i) {
        if (reference[i].samples < 2) continue;
        const double a = area[i];
        for (int c = 0; c < 3; ++c) {
            const double e = baked[i][c], r = reference[i].mean[c];
            const double v = static_cast<double>(reference[i].standardError[c]) *
                             reference[i].standardError[c];
            squares += a * (e - r) * (e - r);
            truthSquares += a * r * r;
            variance += a * v;
            difference += a * (e - r);
            differenceVariance += a * a * v;
            truth += a * r;
        }
        const double r = luminance(reference[i].mean);
        if (r > 0) relative += a * std::abs(luminance(baked[i]) - r) / r;
        areaSum += a;
        ++result.texels;
    }
    if (truthSquares <= 0) return result;
    result.measuredRmse = std::sqrt(squares / truthSquares);
    // E*² itself is too large by the truth's variance.
    const double signal = std::max(truthSquares - variance, 1e-300);
    result.relativeRmse = std::sqrt(std::max(0.0, squares - variance) / signal);
    result.truthError = std::sqrt(variance / signal);
    result.bias = difference / truth;
    result.biasError = std::sqrt(differenceVariance) / truth;
    result.meanRelative = relative / areaSum;
    return result;
}

}  // namespace vlf
