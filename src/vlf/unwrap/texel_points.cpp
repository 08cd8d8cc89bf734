#include "vlf/unwrap/texel_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

struct Located {
    std::uint32_t texel;
    std::uint32_t cell;  // grid point of the texel; kCentroid: a triangle without one
    SurfacePoint point;
};

constexpr std::uint32_t kCentroid = kTexelGrid * kTexelGrid;

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

void locatePoints(const Scene& scene, const Chart& chart, std::uint32_t t,
                  std::vector<Located>& out) {
    const GridTriangle triangle(scene, chart, t);
    const int columns = static_cast<int>(chart.width) * kTexelGrid;
    const int rows = static_cast<int>(chart.height) * kTexelGrid;
    const auto add = [&](int x, int y, std::uint32_t cell, const Vec2& b) {
        const std::uint32_t texel = (y / kTexelGrid) * chart.width + x / kTexelGrid;
        out.push_back({texel, cell, {t, clampedToTriangle(b)}});
    };
    const auto [x0, x1] = std::minmax({triangle.p[0].x, triangle.p[1].x, triangle.p[2].x});
    const auto [y0, y1] = std::minmax({triangle.p[0].y, triangle.p[1].y, triangle.p[2].y});
    bool any = false;
    if (std::abs(triangle.doubleArea) > 1e-12f)
        for (int y = std::max(0, static_cast<int>(y0)); y <= std::min(rows - 1.0f, y1); ++y)
            for (int x = std::max(0, static_cast<int>(x0)); x <= std::min(columns - 1.0f, x1); ++x)
                if (const Vec2 b = triangle.barycentric(Vec2(x + 0.5f, y + 0.5f)); inside(b)) {
                    add(x, y, (y % kTexelGrid) * kTexelGrid + x % kTexelGrid, b);
                    any = true;
                }
    if (any) return;
    const Vec2 centroid = (triangle.p[0] + triangle.p[1] + triangle.p[2]) / 3.0f;
    add(std::clamp(static_cast<int>(centroid.x), 0, columns - 1),
        std::clamp(static_cast<int>(centroid.y), 0, rows - 1), kCentroid, Vec2(1.0f / 3));
}

}  // namespace

TexelPoints findTexelPoints(const Scene& scene, const Chart& chart,
                            const std::vector<std::uint32_t>& triangles) {
    std::vector<Located> located;
    for (const std::uint32_t t : triangles) locatePoints(scene, chart, t, located);
    std::stable_sort(located.begin(), located.end(), [](const Located& a, const Located& b) {
        return a.texel != b.texel ? a.texel < b.texel : a.cell < b.cell;
    });
    TexelPoints result;
    result.first.assign(static_cast<std::size_t>(chart.width) * chart.height + 1, 0);
    for (std::size_t i = 0; i < located.size(); ++i) {
        const Located& p = located[i];
        const bool repeated = i > 0 && p.cell != kCentroid && located[i - 1].texel == p.texel &&
                              located[i - 1].cell == p.cell;
        if (repeated) continue;
        result.points.push_back(p.point);
        ++result.first[p.texel + 1];
    }
    for (std::size_t i = 1; i < result.first.size(); ++i) result.first[i] += result.first[i - 1];
    return result;
}

}  // namespace vlf
