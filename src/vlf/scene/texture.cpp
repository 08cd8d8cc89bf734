#include "vlf/scene/texture.h"

#include "vlf/image/srgb.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

int wrapped(int i, int size, Wrap mode) {
    if (mode == Wrap::clamp) return std::clamp(i, 0, size - 1);
    const int period = mode == Wrap::mirror ? 2 * size : size;
    i %= period;
    if (i < 0) i += period;
    return i < size ? i : period - 1 - i;
}

/// Moves a coordinate near zero by whole periods, so that the conversion to int cannot overflow.
float reduced(float t, Wrap mode) {
    if (mode == Wrap::clamp) return std::clamp(t, -1.0f, 2.0f);
    return t - 2 * std::floor(0.5f * t);
}

}  // namespace

Vec3 Texture::pixel(int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * width + x;
    if (srgb8.empty()) return linear[i];
    const std::uint8_t* p = &srgb8[4 * i];
    return {linearFromSrgb8(p[0]), linearFromSrgb8(p[1]), linearFromSrgb8(p[2])};
}

Vec3 Texture::sample(const Vec2& uv) const {
    const float fx = reduced(uv.x, wrapU) * width - 0.5f;
    const float fy = (1 - reduced(uv.y, wrapV)) * height - 0.5f;
    const int x = static_cast<int>(std::floor(fx)), y = static_cast<int>(std::floor(fy));
    const float s = fx - x, t = fy - y;
    const int x0 = wrapped(x, width, wrapU), x1 = wrapped(x + 1, width, wrapU);
    const int y0 = wrapped(y, height, wrapV), y1 = wrapped(y + 1, height, wrapV);
    return (1 - t) * ((1 - s) * pixel(x0, y0) + s * pixel(x1, y0)) +
           t * ((1 - s) * pixel(x0, y1) + s * pixel(x1, y1));
}

Vec3 Texture::average() const {
    glm::dvec3 sum(0);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) sum += glm::dvec3(pixel(x, y));
    return Vec3(sum / std::max(1.0, static_cast<double>(width) * height));
}

}  // namespace vlf
