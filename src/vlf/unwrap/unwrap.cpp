#include "vlf/unwrap/unwrap.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/field/pack_atlas.h"
#include "vlf/unwrap/buried_points.h"
#include "vlf/unwrap/chart_groups.h"
#include "vlf/unwrap/chart_layout.h"
#include "vlf/unwrap/seams.h"
#include "vlf/unwrap/texel_size.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace vlf {

namespace {

constexpr double kMaxTexels = 1 << 28;

// Charts with more than this share of texels that a wall divides get finer ones, a few times over.
constexpr double kDividedShare = 0.1;
constexpr int kRefinements = 2;
constexpr float kFinestDivided = 0.3f;  // of flat texels: no finer than two halvings

/// The groups there are without pieces: what holds for one holds for all pieces of it.
struct Surfaces {
    Surfaces(const Scene& scene, std::vector<ChartGroup> chartGroups)
        : groups(std::move(chartGroups)), of(groupOfTriangles(groups, scene.triangles.size())) {}

    std::vector<ChartGroup> groups;
    std::vector<std::uint32_t> of;  // by triangle
};

std::vector<OpenSides> sidesOf(const std::vector<ChartGroup>& groups, const Surfaces& surfaces,
                               const std::vector<OpenSides>& sidesOfSurfaces) {
    std::vector<OpenSides> sides;
    for (const ChartGroup& group : groups)
        sides.push_back(sidesOfSurfaces[surfaces.of[group.triangles[0]]]);
    return sides;
}

void checkSize(const Scene& scene, float texelSize) {
    const double texels = texelsNeeded(scene, texelSize);
    if (!(texels < kMaxTexels))
        throw InputError("texels of " + std::to_string(texelSize) + " m would be " +
                         std::to_string(static_cast<long long>(texels)) +
                         ", more than the 2^28 an atlas can hold: choose larger ones");
}

/// Charts of the groups' open sides.
void layOutCharts(const Scene& scene, const std::vector<ChartGroup>& groups,
                  const std::vector<OpenSides>& sides, const std::vector<float>& texelSizes,
                  Unwrap& result) {
    std::vector<Chart> layouts(groups.size());
    parallelFor(groups.size(), 16,
                [&](std::size_t g) { layouts[g] = layOutChart(scene, groups[g], texelSizes[g]); });
    result.charts.clear();
    result.triangleCharts.resize(scene.triangles.size());
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
        TriangleCharts charts;
        if (sides[g].front) {
            charts.front = static_cast<std::uint32_t>(result.charts.size());
            result.charts.push_back(layouts[g]);
        }
        if (sides[g].back) {
            charts.back = static_cast<std::uint32_t>(result.charts.size());
            result.charts.push_back(backOf(layouts[g]));
        }
        for (const std::uint32_t t : groups[g].triangles) result.triangleCharts[t] = charts;
    }
}

/// Adds a chart's texels that have points.
void appendTexels(std::uint32_t c, const TexelPoints& points, Unwrap& result) {
    const Chart& chart = result.charts[c];
    auto& all = result.points.points;
    for (std::uint32_t i = 0; i + 1 < points.first.size(); ++i) {
        const auto texelPoints = points.of(i);
        if (texelPoints.empty()) continue;
        const std::uint32_t x = chart.x + i % chart.width, y = chart.y + i / chart.width;
        result.texels.push_back(y * result.atlasWidth + x);
        result.texelChart.push_back(c);
        all.insert(all.end(), texelPoints.begin(), texelPoints.end());
        result.points.first.push_back(static_cast<std::uint32_t>(all.size()));
    }
}

/// Lists the covered texels of all charts with their points.
void coverTexels(const Scene& scene, Unwrap& result, const Progress& progress) {
    result.texels.clear();
    result.texelChart.clear();
    result.points = {};
    const auto triangles = trianglesOfCharts(result);
    std::vector<TexelPoints> points(result.charts.size());
    parallelFor(points.size(), 4, [&](std::size_t c) {
        progress.check();
        points[c] = findTexelPoints(scene, result.charts[c], triangles[c]);
    });
    result.pointArea.resize(points.size());
    result.points.first.push_back(0);
    for (std::uint32_t c = 0; c < points.size(); ++c) {
        double chartArea = 0;
        progress.check();
        for (const std::uint32_t t : triangles[c]) chartArea += area(scene, t);
        result.pointArea[c] = static_cast<float>(
            chartArea / static_cast<double>(std::max<std::size_t>(1, points[c].points.size())));
        appendTexels(c, points[c], result);
    }
}

/// Pairs every uncovered texel of a chart that has a covered neighbour with it.
void findProxies(Unwrap& result) {
    enum : std::uint8_t { empty, covered, excluded };
    std::vector<std::uint8_t> state(result.atlasSize(), empty);
    for (const std::uint32_t t : result.texels) state[t] = covered;
    for (const auto* texels : {&result.buried, &result.divided})
        for (const ChartTexel& t : *texels) state[t.texel] = excluded;
    result.proxies.clear();
    for (const Chart& c : result.charts)
        for (std::uint32_t y = c.y; y < c.y + c.height; ++y)
            for (std::uint32_t x = c.x; x < c.x + c.width; ++x) {
                const std::uint32_t texel = y * result.atlasWidth + x;
                if (state[texel] != empty) continue;
                // The gutter keeps neighbours of an edge texel within the atlas.
                const std::uint32_t pitch = result.atlasWidth;
                for (const std::uint32_t n : {texel - 1, texel + 1, texel - pitch, texel + pitch})
                    if (state[n] == covered) {
                        result.proxies.emplace_back(texel, n);
                        break;
                    }
            }
}

void findTexels(const Scene& scene, const RayScene& rays, Unwrap& result, Progress& progress) {
    coverTexels(scene, result, progress);
    progress.check();
    dropBuriedPoints(scene, rays, result, progress);
    progress.check();
    findProxies(result);
}

std::vector<float> texelSizes(const Scene& scene, const std::vector<ChartGroup>& groups,
                              float flatSize, const TexelPieces& pieces) {
    std::vector<float> sizes(groups.size());
    parallelFor(groups.size(), 16, [&](std::size_t g) {
        const std::vector<std::uint32_t>& triangles = groups[g].triangles;
        const float scale = pieces.empty() ? 1 : pieces[triangles[0]].scale;
        sizes[g] = scale * texelSizeOf(scene, triangles, flatSize);
    });
    return sizes;
}

/// Halves the texels of surfaces of which walls divide many. Whether there are any.
bool refineDivided(const Unwrap& u, const std::vector<ChartGroup>& groups, const Surfaces& surfaces,
                   std::vector<float>& texelSizes) {
    struct Count {
        double whole = 0, divided = 0;
        bool tooMany() const { return divided > kDividedShare * (whole + divided); }
    };
    std::vector<std::uint32_t> surfaceOf(u.charts.size());
    std::vector<std::uint8_t> isBack(u.charts.size(), 0);
    for (const ChartGroup& group : groups) {
        const std::uint32_t t = group.triangles[0];
        const TriangleCharts& charts = u.triangleCharts[t];
        if (charts.front != kNoChart) surfaceOf[charts.front] = surfaces.of[t];
        if (charts.back != kNoChart)
            surfaceOf[charts.back] = surfaces.of[t], isBack[charts.back] = 1;
    }
    std::vector<std::array<Count, 2>> counts(surfaces.groups.size());
    for (const std::uint32_t c : u.texelChart) ++counts[surfaceOf[c]][isBack[c]].whole;
    for (const ChartTexel& t : u.divided) ++counts[surfaceOf[t.chart]][isBack[t.chart]].divided;
    bool any = false;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto& [front, back] = counts[surfaces.of[groups[g].triangles[0]]];
        if (!front.tooMany() && !back.tooMany()) continue;
        if (texelSizes[g] < kFinestDivided * u.texelSize) continue;
        texelSizes[g] *= 0.5f;
        any = true;
    }
    return any;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> trianglesOfCharts(const Unwrap& unwrap) {
    std::vector<std::vector<std::uint32_t>> triangles(unwrap.charts.size());
    for (std::uint32_t t = 0; t < unwrap.triangleCharts.size(); ++t)
        for (const std::uint32_t c :
             {unwrap.triangleCharts[t].front, unwrap.triangleCharts[t].back})
            if (c != kNoChart) triangles[c].push_back(t);
    return triangles;
}

Unwrap unwrap(const Scene& scene, const RayScene& rays, const UnwrapParams& params,
              Progress& progress) {
    Unwrap result;
    result.texelSize =
        params.texelSize > 0 ? params.texelSize : texelSizeForBudget(scene, params.texelBudget);
    checkSize(scene, result.texelSize);
    const Surfaces surfaces(scene, groupTriangles(scene, result.texelSize));
    const std::vector<ChartGroup> groups =
        params.pieces.empty() ? surfaces.groups
                              : groupTriangles(scene, result.texelSize, params.pieces);
    progress.check();
    const std::vector<OpenSides> sides =
        params.sides
            ? std::vector<OpenSides>(groups.size(), *params.sides)
            : sidesOf(groups, surfaces,
                      findOpenSides(scene, rays, surfaces.groups, surfaces.of, params.seed));
    std::vector<float> sizes = texelSizes(scene, groups, result.texelSize, params.pieces);
    for (int refinements = 0;; ++refinements) {
        progress.check();
        layOutCharts(scene, groups, sides, sizes, result);
        const AtlasSize size = packCharts(result.charts);
        result.atlasWidth = size.width;
        result.atlasHeight = size.height;
        findTexels(scene, rays, result, progress);
        if (refinements == kRefinements || !refineDivided(result, groups, surfaces, sizes)) break;
    }
    result.seams = findSeams(scene, rays, result);
    return result;
}

Unwrap unwrap(const Scene& scene, const RayScene& rays, const UnwrapParams& params) {
    Progress uninterrupted;
    return unwrap(scene, rays, params, uninterrupted);
}

Unwrap restoreUnwrap(const Scene& scene, const RayScene& rays, const std::vector<Chart>& charts,
                     const std::vector<TriangleCharts>& triangleCharts, const AtlasSize& atlas) {
    Unwrap result;
    result.charts = charts;
    result.triangleCharts = triangleCharts;
    result.atlasWidth = atlas.width;
    result.atlasHeight = atlas.height;
    for (const Chart& chart : charts)
        result.texelSize = std::max(result.texelSize, chart.texelSize());
    Progress uninterrupted;
    findTexels(scene, rays, result, uninterrupted);
    return result;
}

}  // namespace vlf
