#include "vlf/unwrap/texel_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vlf {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr int kCells = kTexelGrid * kTexelGrid;

/// The chart's grid points, texel by texel, and the triangles that hold none of them.
struct Located {
    std::vector<SurfacePoint> grid;  // kCells a texel; triangle kNone: not covered
    std::vector<std::pair<std::uint32_t, SurfacePoint>> centroids;  // with their texel
};

/// A triangle in units of grid points.
struct GridTriangle {
    std::array<Vec2, 3> p;
    float doubleArea;

    GridTriangle(const Scene& scene, const Chart& chart, std::uint32_t t) {
        for (int c = 0; c < 3; ++c)
            p[c] = chart.texelCoordinates(scene.position(t, c)) * static_cast<float>(kTexelGrid);
        doubleArea = cross(p[1] - p[0], p[2] - p[0]);
    }

    static float cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

    /// Weights of the second and third vertex.
    Vec2 barycentric(const Vec2& q) const {
        return Vec2(cross(q - p[0], p[2] - p[0]), cross(p[1] - p[0], q - p[0])) / doubleArea;
    }
};

bool inside(const Vec2& b) {
    constexpr float kEdge = -1e-4f;  // points on an edge belong to both triangles
    return b.x >= kEdge && b.y >= kEdge && b.x + b.y <= 1 - kEdge;
}

Vec2 clampedToTriangle(const Vec2& b) {
    const Vec2 c = glm::max(b, Vec2(0));
    return c / std::max(1.0f, c.x + c.y);
}

void locatePoints(const Scene& scene, const Chart& chart, std::uint32_t t, Located& out) {
    const GridTriangle triangle(scene, chart, t);
    const int columns = static_cast<int>(chart.width) * kTexelGrid;
    const int rows = static_cast<int>(chart.height) * kTexelGrid;
    const auto texelOf = [&](int x, int y) {
        return static_cast<std::uint32_t>(y / kTexelGrid) * chart.width + x / kTexelGrid;
    };
    const auto [x0, x1] = std::minmax({triangle.p[0].x, triangle.p[1].x, triangle.p[2].x});
    const auto [y0, y1] = std::minmax({triangle.p[0].y, triangle.p[1].y, triangle.p[2].y});
    bool any = false;
    if (std::abs(triangle.doubleArea) > 1e-12f)
        for (int y = std::max(0, static_cast<int>(y0)); y <= std::min(rows - 1.0f, y1); ++y)
            for (int x = std::max(0, static_cast<int>(x0)); x <= std::min(columns - 1.0f, x1); ++x)
                if (const Vec2 b = triangle.barycentric(Vec2(x + 0.5f, y + 0.5f)); inside(b)) {
                    const int cell = (y % kTexelGrid) * kTexelGrid + x % kTexelGrid;
                    SurfacePoint& point = out.grid[kCells * std::size_t{texelOf(x, y)} + cell];
                    if (point.triangle == kNone) point = {t, clampedToTriangle(b)};
                    any = true;
                }
    if (any) return;
    const Vec2 centroid = (triangle.p[0] + triangle.p[1] + triangle.p[2]) / 3.0f;
    const int x = std::clamp(static_cast<int>(centroid.x), 0, columns - 1);
    const int y = std::clamp(static_cast<int>(centroid.y), 0, rows - 1);
    out.centroids.push_back({texelOf(x, y), {t, Vec2(1.0f / 3)}});
}

}  // namespace

TexelPoints findTexelPoints(const Scene& scene, const Chart& chart,
                            const std::vector<std::uint32_t>& triangles) {
    const std::size_t texels = static_cast<std::size_t>(chart.width) * chart.height;
    Located located;
    located.grid.assign(kCells * texels, {kNone, {}});
    for (const std::uint32_t t : triangles) locatePoints(scene, chart, t, located);
    std::stable_sort(located.centroids.begin(), located.centroids.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    TexelPoints result;
    result.first.reserve(texels + 1);
    result.points.reserve(kCells * texels + located.centroids.size());
    auto centroid = located.centroids.begin();
    for (std::size_t texel = 0; texel < texels; ++texel) {
        result.first.push_back(static_cast<std::uint32_t>(result.points.size()));
        for (int cell = 0; cell < kCells; ++cell)
            if (const SurfacePoint& p = located.grid[kCells * texel + cell]; p.triangle != kNone)
                result.points.push_back(p);
        for (; centroid != located.centroids.end() && centroid->first == texel; ++centroid)
            result.points.push_back(centroid->second);
    }
    result.first.push_back(static_cast<std::uint32_t>(result.points.size()));
    return result;
}

MeanReflectance meanReflectance(const Scene& scene, std::span<const SurfacePoint> points) {
    const Material& material = scene.material(points[0].triangle);
    const bool textured = material.diffuseTexture >= 0 || material.mirrorTexture >= 0;
    const auto samples = textured ? points : points.first(1);
    MeanReflectance sum;
    for (const SurfacePoint& p : samples) {
        const Vec2 uv = uvAt(scene, p.triangle, p.barycentric);
        sum.diffuse += diffuseReflectance(scene, material, uv);
        sum.mirror += mirrorReflectance(scene, material, uv);
    }
    const auto n = static_cast<float>(samples.size());
    return {sum.diffuse / n, sum.mirror / n};
}

}  // namespace vlf
