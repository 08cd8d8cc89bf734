#pragma once
// All charts' texels in one image.

#include "vlf/field/chart.h"
#include "vlf/math/vector.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vlf {

/// Irradiance (W·m⁻², RGB) arriving at each texel on the side its chart faces, row-major, row 0
/// at v = 0. Texels no surface covers, gutters included, hold a continuation of their chart's
/// values, so that bilinear interpolation needs no case.
struct IrradianceAtlas {
    std::uint32_t width = 0, height = 0;
    std::vector<Vec3> irradiance;

    std::size_t index(std::uint32_t x, std::uint32_t y) const {
        return static_cast<std::size_t>(y) * width + x;
    }
    const Vec3& at(std::uint32_t x, std::uint32_t y) const { return irradiance[index(x, y)]; }

    /// Bilinearly interpolated irradiance at texel coordinates of `chart`, which are clamped to
    /// the chart.
    Vec3 sample(const Chart& chart, const Vec2& texelCoordinates) const;
};

}  // namespace vlf
