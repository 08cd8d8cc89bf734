#pragma once
// A chart: a piece of one surface, of one material, that projects one-to-one onto a plane. Its
// texels are a regular grid on that plane, so that texel coordinates are an affine function of
// position: the same for a wall and for a patch of a statue.

#include "vlf/math/vector.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace vlf {

inline constexpr std::uint32_t kNoChart = 0xffffffffu;

struct Chart {
    /// Texel coordinates of world point p: (dot(uAxis, p) + uOffset, dot(vAxis, p) + vOffset),
    /// in [0, width] x [0, height]; texel (i, j) covers [i, i+1) x [j, j+1).
    Vec3 uAxis, vAxis;  ///< texels per metre
    float uOffset = 0, vOffset = 0;
    Vec3 normal;                          ///< unit; the side the texels face
    std::uint32_t x = 0, y = 0;           ///< atlas position of texel (0, 0)
    std::uint32_t width = 0, height = 0;  ///< texels, without the gutter
    std::uint32_t material = 0;
    bool planar = false;  ///< all of its surface lies in one plane

    Vec2 texelCoordinates(const Vec3& p) const {
        return {glm::dot(uAxis, p) + uOffset, glm::dot(vAxis, p) + vOffset};
    }

    /// World point of texel coordinates on the plane through `anchor` perpendicular to the normal.
    Vec3 pointAt(const Vec2& coordinates, const Vec3& anchor) const {
        const Vec2 step = coordinates - texelCoordinates(anchor);
        return anchor + uAxis * (step.x / glm::dot(uAxis, uAxis)) +
               vAxis * (step.y / glm::dot(vAxis, vAxis));
    }

    /// Longer side of a texel, metres.
    float texelSize() const { return 1 / std::min(glm::length(uAxis), glm::length(vAxis)); }
};

/// Which chart holds each side of a display triangle; kNoChart for a side that needs none (the
/// inside of a solid).
struct TriangleCharts {
    std::uint32_t front = kNoChart, back = kNoChart;
};

/// Width, in texels, of the border of every chart in the atlas: bilinear sampling anywhere on a
/// chart stays within chart and border.
inline constexpr std::uint32_t kGutter = 1;

}  // namespace vlf
