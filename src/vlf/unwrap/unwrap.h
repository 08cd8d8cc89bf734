#pragma once
// Charts and texels of a scene: every surface that light can reach gets a place in the irradiance
// atlas.

#include "vlf/base/progress.h"
#include "vlf/field/chart.h"
#include "vlf/field/pack_atlas.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/side_exposure.h"
#include "vlf/unwrap/texel_piece.h"
#include "vlf/unwrap/texel_points.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace vlf {

/// A texel that continues its chart across a seam: its value is the irradiance of another chart at
/// `coordinates` (texel coordinates there).
struct SeamLink {
    std::uint32_t texel;  ///< atlas index
    std::uint32_t chart;
    Vec2 coordinates;
};

/// A texel and the chart it is of.
struct ChartTexel {
    std::uint32_t texel;  ///< atlas index
    std::uint32_t chart;
};

struct Unwrap {
    std::vector<Chart> charts;
    std::vector<TriangleCharts> triangleCharts;  ///< one per triangle
    std::uint32_t atlasWidth = 0, atlasHeight = 0;
    float texelSize = 0;  ///< metres, of flat surfaces; finer where they bend

    /// The texels a surface covers, and for each its atlas index, chart and surface points.
    std::vector<std::uint32_t> texels;
    std::vector<std::uint32_t> texelChart;
    TexelPoints points;
    std::vector<float> pointArea;  ///< per chart: surface area that a point stands for, m²

    /// Texels that take no part in transport, being neither samples nor receivers: those within
    /// solids or behind panels, and those that a wall stands across.
    std::vector<ChartTexel> buried, divided;

    /// Texels within a chart that the points miss but a ray may still hit (slivers of the
    /// surface), and the covered neighbour that stands for them. Atlas indices.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> proxies;

    std::vector<SeamLink> seams;

    float texelArea(std::size_t i) const {
        return pointArea[texelChart[i]] * static_cast<float>(points.of(i).size());
    }
    std::size_t atlasSize() const { return static_cast<std::size_t>(atlasWidth) * atlasHeight; }
};

/// The triangles of which each chart shows a side.
std::vector<std::vector<std::uint32_t>> trianglesOfCharts(const Unwrap& unwrap);

struct UnwrapParams {
    float texelSize = 0;         ///< metres, of flat surfaces; 0: from the budget
    double texelBudget = 75000;  ///< about how many texels to spend on the scene
    std::uint64_t seed = 0;
    std::optional<OpenSides> sides =
        std::nullopt;      ///< that have texels; none: those that light can reach
    TexelPieces pieces{};  ///< that have texels of another size than the rest
};

/// Throws InputError if the scene would need more than 2^28 texels, Cancelled.
Unwrap unwrap(const Scene& scene, const RayScene& rays, const UnwrapParams& params,
              Progress& progress);

/// The same, for whoever will not cancel it.
Unwrap unwrap(const Scene& scene, const RayScene& rays, const UnwrapParams& params);

/// The texels of a finished field, from its charts: for measuring it. Seams are left out.
Unwrap restoreUnwrap(const Scene& scene, const RayScene& rays, const std::vector<Chart>& charts,
                     const std::vector<TriangleCharts>& triangleCharts, const AtlasSize& atlas);

}  // namespace vlf
