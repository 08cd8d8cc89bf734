#include "vlf/unwrap/buried_points.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace {

constexpr std::size_t kProbes = 4;  // points tried before all of a texel's are

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

  private:
    bool isOpen(std::size_t texel, const SurfacePoint& point) const {
        const std::uint32_t chart = unwrap_.texelChart[texel];
        const bool front = unwrap_.triangleCharts[point.triangle].front == chart;
        const Vec3 n = geometricNormal(scene_, point.triangle) * (front ? 1.0f : -1.0f);
        const Vec3 p = positionAt(scene_, point.triangle, point.barycentric);
        const Hit hit = rays_.closest({p + rays_.epsilon() * n, n});
        if (!hit) return true;
        const bool seesFront = glm::dot(geometricNormal(scene_, hit.triangle), n) < 0;
        const TriangleCharts& charts = unwrap_.triangleCharts[hit.triangle];
        return (seesFront ? charts.front : charts.back) != kNoChart;
    }

    const Scene& scene_;
    const RayScene& rays_;
    const Unwrap& unwrap_;
};

}  // namespace

void dropBuriedPoints(const Scene& scene, const RayScene& rays, Unwrap& unwrap) {
    std::vector<std::uint8_t> keep(unwrap.points.points.size());
    const BurialTest test(scene, rays, unwrap);
    parallelFor(unwrap.texels.size(), 256, [&](std::size_t i) {
        const std::uint32_t begin = unwrap.points.first[i], end = unwrap.points.first[i + 1];
        test(i, std::span(keep).subspan(begin, end - begin));
    });
    TexelPoints kept;
    kept.first.push_back(0);
    std::size_t texels = 0;
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i) {
        for (std::uint32_t k = unwrap.points.first[i]; k < unwrap.points.first[i + 1]; ++k)
            if (keep[k]) kept.points.push_back(unwrap.points.points[k]);
        if (kept.points.size() == kept.first.back()) continue;
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
