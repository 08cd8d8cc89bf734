#include "vlf/unwrap/seams.h"

#include "vlf/base/parallel.h"

#include <cmath>
#include <optional>

namespace vlf {

namespace {

constexpr float kSameFacing = 0.64f;  // cos 50°, as charts of curved surfaces allow
constexpr float kReach = 1.5f;        // texels above and below the chart to look for its neighbour

std::optional<SeamLink> findLink(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                                 std::uint32_t chartIndex, std::uint32_t texel, const Vec2& centre,
                                 const SurfacePoint& neighbour) {
    const Chart& chart = unwrap.charts[chartIndex];
    const Vec3 anchor = positionAt(scene, neighbour.triangle, neighbour.barycentric);
    const float reach = kReach * chart.texelSize();
    const Vec3 p = chart.pointAt(centre, anchor);
    const Hit hit = rays.closest({p + reach * chart.normal, -chart.normal, 0, 2 * reach});
    if (!hit) return std::nullopt;
    const Vec3 normal = geometricNormal(scene, hit.triangle);
    const bool front = glm::dot(normal, chart.normal) > 0;
    const TriangleCharts& charts = unwrap.triangleCharts[hit.triangle];
    const std::uint32_t other = front ? charts.front : charts.back;
    if (other == kNoChart || other == chartIndex) return std::nullopt;
    if (std::abs(glm::dot(normal, chart.normal)) < kSameFacing) return std::nullopt;
    if (chart.planar && std::abs(hit.t - reach) > 0.1f * reach) return std::nullopt;
    const Vec3 q = positionAt(scene, hit.triangle, hit.barycentric);
    return SeamLink{texel, other, unwrap.charts[other].texelCoordinates(q)};
}

/// Index into unwrap.texels of every atlas texel, or kNone.
constexpr std::uint32_t kNone = 0xffffffffu;

std::vector<std::uint32_t> texelLookup(const Unwrap& unwrap) {
    std::vector<std::uint32_t> lookup(unwrap.atlasSize(), kNone);
    for (std::uint32_t i = 0; i < unwrap.texels.size(); ++i) lookup[unwrap.texels[i]] = i;
    return lookup;
}

void linkChart(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
               const std::vector<std::uint32_t>& lookup, std::uint32_t c,
               std::vector<SeamLink>& links) {
    const Chart& chart = unwrap.charts[c];
    const int width = static_cast<int>(chart.width), height = static_cast<int>(chart.height);
    const auto covered = [&](int x, int y) {
        return x < 0 || y < 0 || x >= width || y >= height
                   ? kNone
                   : lookup[(chart.y + y) * unwrap.atlasWidth + chart.x + x];
    };
    const auto neighbour = [&](int x, int y) {
        for (const auto& [dx, dy] :
             {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}})
            if (const std::uint32_t n = covered(x + dx, y + dy); n != kNone) return n;
        return kNone;
    };
    for (int y = -1; y <= height; ++y)
        for (int x = -1; x <= width; ++x) {
            if (covered(x, y) != kNone) continue;
            const std::uint32_t near = neighbour(x, y);
            if (near == kNone) continue;
            const std::uint32_t texel = (chart.y + y) * unwrap.atlasWidth + chart.x + x;
            const auto points = unwrap.points.of(near);
            if (auto link = findLink(scene, rays, unwrap, c, texel, Vec2(x + 0.5f, y + 0.5f),
                                     points[points.size() / 2]))
                links.push_back(*link);
        }
}

}  // namespace

std::vector<SeamLink> findSeams(const Scene& scene, const RayScene& rays, const Unwrap& unwrap) {
    const std::vector<std::uint32_t> lookup = texelLookup(unwrap);
    std::vector<std::vector<SeamLink>> perChart(unwrap.charts.size());
    parallelFor(unwrap.charts.size(), 4, [&](std::size_t c) {
        linkChart(scene, rays, unwrap, lookup, static_cast<std::uint32_t>(c), perChart[c]);
    });
    std::vector<SeamLink> all;
    for (const auto& links : perChart) all.insert(all.end(), links.begin(), links.end());
    return all;
}

}  // namespace vlf
