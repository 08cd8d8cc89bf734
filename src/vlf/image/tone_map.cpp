#include "vlf/image/tone_map.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

/// K. Narkowicz, ACES filmic tone mapping curve, 2016: a rational fit.
float filmic(float x) {
    if (x > 1e4f) return 1;
    return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

float toneMap(float x, ToneCurve curve) {
    if (!(x > 0)) return 0;
    return curve == ToneCurve::filmic ? filmic(x) : std::min(x, 1.0f);
}

}  // namespace

Vec3 toneMap(const Vec3& color, ToneCurve curve) {
    return {toneMap(color.x, curve), toneMap(color.y, curve), toneMap(color.z, curve)};
}

Image toneMap(const Image& image, float exposure, ToneCurve curve) {
    const float scale = std::exp2(exposure);
    Image result(image.width, image.height);
    parallelFor(image.pixels.size(), 4096,
                [&](std::size_t i) { result.pixels[i] = toneMap(scale * image.pixels[i], curve); });
    return result;
}

float autoExposure(const Image& image) {
    double sum = 0;
    std::size_t finite = 0;
    for (const Vec3& p : image.pixels)
        if (isFinite(p)) sum += luminance(p), ++finite;
    const double black = finite > 0 ? 1e-4 * sum / static_cast<double>(finite) : 0;
    double logSum = 0;
    std::size_t lit = 0;
    for (const Vec3& p : image.pixels) {
        const double y = luminance(p);
        if (isFinite(p) && y > 0 && y >= black) logSum += std::log2(y), ++lit;
    }
    if (lit == 0) return 0;
    return static_cast<float>(std::log2(0.18) - logSum / static_cast<double>(lit));
}

}  // namespace vlf
