#include "vlf/field/irradiance_atlas.h"

#include <algorithm>
#include <cmath>

namespace vlf {

Vec3 IrradianceAtlas::sample(const Chart& chart, const Vec2& texelCoordinates) const {
    const float u = std::clamp(texelCoordinates.x, 0.0f, static_cast<float>(chart.width));
    const float v = std::clamp(texelCoordinates.y, 0.0f, static_cast<float>(chart.height));
    // Texel centres lie at half-integers; the gutter makes index -1 of a chart valid.
    const float fx = chart.x + u - 0.5f, fy = chart.y + v - 0.5f;
    const auto x = static_cast<std::uint32_t>(fx), y = static_cast<std::uint32_t>(fy);
    const float s = fx - x, t = fy - y;
    return (1 - t) * ((1 - s) * at(x, y) + s * at(x + 1, y)) +
           t * ((1 - s) * at(x, y + 1) + s * at(x + 1, y + 1));
}

}  // namespace vlf
