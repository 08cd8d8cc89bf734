#include "vlf/dynamic/changed_charts.h"

#include <algorithm>
#include <limits>

namespace vlf {

namespace {

constexpr float kToleratedCells = 3;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

Vec3 ChangedCharts::factorOf(const Vec3& with, const Vec3& without) {
    Vec3 factor(1);
    for (int c = 0; c < 3; ++c)
        if (without[c] > 0) factor[c] = std::clamp(with[c] / without[c], 0.0f, kMaxFactor);
    return factor;
}

ChangedCharts::ChangedCharts(const Scene& scene, const LightField& field)
    : field_(field), all_(field.charts.size()), follows_(field.charts.size(), 0) {
    const int cells = field.radiance.empty() ? field.record.cells : field.radiance.cells;
    tolerance_ = kToleratedCells * 2 * field.frame.radius / static_cast<float>(std::max(cells, 1));
    for (std::size_t c = 0; c < all_.size(); ++c) {
        const Chart& chart = field.charts[c];
        const Material& material = scene.materials[chart.material];
        follows_[c] = !material.isEmitter() && !material.isPureMirror();
        all_[c].chart = static_cast<std::uint32_t>(c);
        all_[c].planar = chart.planar;
        all_[c].lower = kInfinity, all_[c].upper = -kInfinity;
    }
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (const std::uint32_t c : {field.triangleCharts[t].front, field.triangleCharts[t].back})
            if (c != kNoChart)
                for (int corner = 0; corner < 3; ++corner) {
                    const float d = glm::dot(field.charts[c].normal, scene.position(t, corner));
                    all_[c].lower = std::min(all_[c].lower, d);
                    all_[c].upper = std::max(all_[c].upper, d);
                }
    for (ChangedChart& chart : all_)
        if (chart.planar) chart.lower = chart.upper = 0.5f * (chart.lower + chart.upper);
}

void ChangedCharts::update(const IrradianceAtlas& with, const IrradianceAtlas& without) {
    changed_.clear();
    for (std::size_t c = 0; c < all_.size(); ++c) {
        if (!follows_[c]) continue;
        const Chart& chart = field_.charts[c];
        ChangedChart found = all_[c];
        found.first = Vec2(kInfinity), found.last = Vec2(-kInfinity);
        for (std::uint32_t y = 0; y < chart.height; ++y)
            for (std::uint32_t x = 0; x < chart.width; ++x) {
                const Vec3& now = with.at(chart.x + x, chart.y + y);
                const Vec3& before = without.at(chart.x + x, chart.y + y);
                if (now == before ||
                    maxComponent(glm::abs(now - before) - kNoticeable * before) <= 0)
                    continue;
                const Vec2 texel(static_cast<float>(x), static_cast<float>(y));
                found.first = glm::min(found.first, texel - 1.0f);
                found.last = glm::max(found.last, texel + 2.0f);
                found.change += luminance(glm::abs(now - before));
            }
        if (found.change > 0) changed_.push_back(found);
    }
    std::stable_sort(
        changed_.begin(), changed_.end(),
        [](const ChangedChart& a, const ChangedChart& b) { return a.change > b.change; });
    if (changed_.size() > kMaxCharts) changed_.resize(kMaxCharts);
}

ChangedCharts::Place ChangedCharts::find(const Vec3& origin, const Vec3& direction,
                                         float distance) const {
    Place place;
    float nearest = tolerance_;
    for (const ChangedChart& changed : changed_) {
        const Chart& chart = field_.charts[changed.chart];
        const float slope = glm::dot(chart.normal, direction);
        if (slope >= 0) continue;
        Vec3 p = origin + distance * direction;
        const float depth = glm::dot(chart.normal, p);
        const float off = std::max({changed.lower - depth, depth - changed.upper, 0.0f});
        if (off > nearest) continue;
        // The distance is that of a cell; a plane says more exactly where the ray meets it.
        if (changed.planar) p += (changed.lower - depth) / slope * direction;
        const Vec2 texel = chart.texelCoordinates(p);
        if (texel.x < changed.first.x || texel.y < changed.first.y || texel.x > changed.last.x ||
            texel.y > changed.last.y)
            continue;
        place = {&chart, texel};
        nearest = off;
    }
    return place;
}

Vec3 ChangedCharts::factor(const Vec3& origin, const Vec3& direction, float distance,
                           const IrradianceAtlas& with, const IrradianceAtlas& without) const {
    const Place place = find(origin, direction, distance);
    if (!place.chart) return Vec3(1);
    return factorOf(with.sample(*place.chart, place.texel),
                    without.sample(*place.chart, place.texel));
}

}  // namespace vlf
