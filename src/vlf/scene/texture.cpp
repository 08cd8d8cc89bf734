#include "vlf/scene/texture.h"

#include "vlf/image/srgb.h"
#include "vlf/scene/texture_coordinates.h"

#include <algorithm>

namespace vlf {

Vec3 Texture::pixel(int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * width + x;
    if (srgb8.empty()) return linear[i];
    const std::uint8_t* p = &srgb8[4 * i];
    return {linearFromSrgb8(p[0]), linearFromSrgb8(p[1]), linearFromSrgb8(p[2])};
}

Vec3 Texture::sample(const Vec2& uv) const {
    const BilinearPlace at(uv, width, height, wrapU, wrapV);
    return (1 - at.t) * ((1 - at.s) * pixel(at.x0, at.y0) + at.s * pixel(at.x1, at.y0)) +
           at.t * ((1 - at.s) * pixel(at.x0, at.y1) + at.s * pixel(at.x1, at.y1));
}

Vec3 Texture::average() const {
    glm::dvec3 sum(0);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) sum += glm::dvec3(pixel(x, y));
    return Vec3(sum / std::max(1.0, static_cast<double>(width) * height));
}

}  // namespace vlf
