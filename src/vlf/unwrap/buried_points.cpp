#include "vlf/unwrap/buried_points.h"

#include "vlf/base/parallel.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/unwrap/wall_between.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace {

constexpr std::size_t kProbes = 4;  // points tried before all of a texel's are
constexpr int kDirections = 12;     // that a point under a closed side looks in

class BurialTest {
  public:
    BurialTest(const Scene& scene, const RayScene& rays, const Unwrap& unwrap)
        : scene_(scene), rays_(rays), unwrap_(unwrap) {}

    /// Sets keep[i] for the points of a texel. Texels whose probes all see open surfaces are not
    /// looked at further.
    void operator()(std::size_t texel, std::span<std::uint8_t> keep) const {
        const auto points = unwrap_.points.of(texel);
        const std::size_t probes = std::min(kProbes, points.size());
        std::array<std::uint8_t, kProbes> open{};
        for (std::size_t i = 0; i < probes; ++i)
            open[i] = isOpen(
                texel, points[i * (points.size() - 1) / std::max<std::size_t>(1, probes - 1)]);
        const bool allOpen =
            std::all_of(open.begin(), open.begin() + probes, [](std::uint8_t o) { return o != 0; });
        for (std::size_t i = 0; i < points.size(); ++i)
            keep[i] = allOpen || isOpen(texel, points[i]);
    }

    /// Whether a wall stands across the texel: its open corners do not see each other along the
    /// surface.
    bool isDivided(std::size_t texel, std::span<const std::uint8_t> keep) const {
        const auto points = unwrap_.points.of(texel);
        const Chart& chart = unwrap_.charts[unwrap_.texelChart[texel]];
        if (!chart.planar || points.size() < 2) return false;
        const std::size_t last = points.size() - 1;
        const bool full = points.size() == kTexelGrid * kTexelGrid;
        const auto blocked = [&](std::size_t a, std::size_t b) {
            return keep[a] && keep[b] &&
                   wallBetween(rays_, chart, positionOf(points[a]), positionOf(points[b]));
        };
        return blocked(0, last) || (full && blocked(kTexelGrid - 1, last - (kTexelGrid - 1)));
    }

  private:
    Vec3 positionOf(const SurfacePoint& p) const {
        return positionAt(scene_, p.triangle, p.barycentric);
    }

    /// A closed side straight above is a hint, one in most directions the proof: down a deep shaft,
    /// too, one may see a side that no light was found to reach.
    bool isOpen(std::size_t texel, const SurfacePoint& point) const {
        const std::uint32_t chart = unwrap_.texelChart[texel];
        const bool front = unwrap_.triangleCharts[point.triangle].front == chart;
        const Vec3 n = geometricNormal(scene_, point.triangle) * (front ? 1.0f : -1.0f);
        const Vec3 p = positionOf(point) + rays_.epsilon() * n;
        if (seesOpen(Ray{p, n})) return true;
        const Frame frame = frameFromNormal(n);
        std::uint32_t closed = 0;
        for (std::uint32_t i = 0; i < kDirections && 2 * closed < kDirections; ++i)
            closed +=
                !seesOpen(Ray{p, frame.toWorld(sampleCosineHemisphere(r2Point(i, Vec2(0.5f))))});
        return 2 * closed < kDirections;
    }

    bool seesOpen(const Ray& ray) const {
        const Hit hit = rays_.closest(ray);
        if (!hit) return true;
        const bool front = glm::dot(geometricNormal(scene_, hit.triangle), ray.direction) < 0;
        const TriangleCharts& charts = unwrap_.triangleCharts[hit.triangle];
        return (front ? charts.front : charts.back) != kNoChart;
    }

    const Scene& scene_;
    const RayScene& rays_;
    const Unwrap& unwrap_;
};

}  // namespace

void dropBuriedPoints(const Scene& scene, const RayScene& rays, Unwrap& unwrap,
                      const Progress& progress) {
    std::vector<std::uint8_t> keep(unwrap.points.points.size());
    std::vector<std::uint8_t> divided(unwrap.texels.size());
    const BurialTest test(scene, rays, unwrap);
    parallelFor(unwrap.texels.size(), 256, [&](std::size_t i) {
        progress.check();
        const std::uint32_t begin = unwrap.points.first[i], end = unwrap.points.first[i + 1];
        const std::span<std::uint8_t> own = std::span(keep).subspan(begin, end - begin);
        test(i, own);
        divided[i] = test.isDivided(i, own);
        if (divided[i]) std::fill(own.begin(), own.end(), std::uint8_t{0});
    });
    unwrap.divided.clear();
    unwrap.buried.clear();
    for (std::size_t i = 0; i < divided.size(); ++i)
        if (divided[i]) unwrap.divided.push_back({unwrap.texels[i], unwrap.texelChart[i]});
    TexelPoints kept;
    kept.first.push_back(0);
    std::size_t texels = 0;
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i) {
        for (std::uint32_t k = unwrap.points.first[i]; k < unwrap.points.first[i + 1]; ++k)
            if (keep[k]) kept.points.push_back(unwrap.points.points[k]);
        if (kept.points.size() == kept.first.back()) {
            if (!divided[i]) unwrap.buried.push_back({unwrap.texels[i], unwrap.texelChart[i]});
            continue;
        }
        kept.first.push_back(static_cast<std::uint32_t>(kept.points.size()));
        unwrap.texels[texels] = unwrap.texels[i];
        unwrap.texelChart[texels] = unwrap.texelChart[i];
        ++texels;
    }
    unwrap.texels.resize(texels);
    unwrap.texelChart.resize(texels);
    unwrap.points = std::move(kept);
}

}  // namespace vlf
