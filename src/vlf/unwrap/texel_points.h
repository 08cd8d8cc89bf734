#pragma once
// Where in the world the texels are: a few stratified surface points for each.

#include "vlf/field/chart.h"
#include "vlf/scene/scene.h"
#include "vlf/unwrap/chart_groups.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// A point of a triangle; barycentric weights of its second and third vertex.
struct SurfacePoint {
    std::uint32_t triangle = 0;
    Vec2 barycentric{0};
};

/// Points per texel along each side when the surface covers all of it.
inline constexpr int kTexelGrid = 4;

/// Surface points of a set of texels: of texel i points[first[i]] .. points[first[i + 1]], at most
/// kTexelGrid² and one for each triangle too small to hold a grid point. A texel's covered area is
/// in proportion to its number of points.
struct TexelPoints {
    std::vector<std::uint32_t> first;
    std::vector<SurfacePoint> points;

    std::span<const SurfacePoint> of(std::size_t texel) const {
        return {points.data() + first[texel], points.data() + first[texel + 1]};
    }
};

/// Points of a chart's texels, row by row. `triangles` are the chart's.
TexelPoints findTexelPoints(const Scene& scene, const Chart& chart,
                            const std::vector<std::uint32_t>& triangles);

struct MeanReflectance {
    Vec3 diffuse{0}, mirror{0};
};

/// Over surface points of one material, textures included.
MeanReflectance meanReflectance(const Scene& scene, std::span<const SurfacePoint> points);

}  // namespace vlf
