#include "vlf/propagate/mirror_gather.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr float kMinThroughput = 1e-4f;

std::uint32_t texelAt(const Unwrap& unwrap, std::uint32_t chartIndex, const Vec3& p) {
    const Chart& chart = unwrap.charts[chartIndex];
    const Vec2 t = chart.texelCoordinates(p);
    const auto x = static_cast<std::uint32_t>(std::clamp(t.x, 0.0f, chart.width - 1.0f));
    const auto y = static_cast<std::uint32_t>(std::clamp(t.y, 0.0f, chart.height - 1.0f));
    return (chart.y + y) * unwrap.atlasWidth + chart.x + x;
}

}  // namespace

void MirrorGatherer::start(const ParallelSubfield& subfield,
                           const std::vector<MirrorSight>& sights) {
    // Rays leave from just before the mirror: everything up to it is known to be empty.
    paths_.clear();
    rayQueue_.clear();
    const float perCell = 1 / glm::dot(subfield.xAxis, subfield.xAxis);
    const Vec3 origin = -(perCell * (subfield.xOffset - 0.5f)) * subfield.xAxis -
                        (perCell * (subfield.yOffset - 0.5f)) * subfield.yAxis -
                        subfield.depthOffset * subfield.direction;
    for (const MirrorSight& s : sights) {
        const float sense = s.forward ? 1.0f : -1.0f;
        const float depth = s.depth + sense * rays_.epsilon();
        rayQueue_.push_back({origin + (perCell * s.x) * subfield.xAxis +
                                 (perCell * s.y) * subfield.yAxis + depth * subfield.direction,
                             sense * subfield.direction});
        paths_.push_back({s.receiver, Vec3(1), true});
    }
}

void MirrorGatherer::advance(int reflections, const TexelBuffer& radiance, TexelBuffer& gathered) {
    hits_.resize(rayQueue_.size());
    rays_.closest(rayQueue_, hits_);
    nextPaths_.clear();
    nextRays_.clear();
    for (std::size_t i = 0; i < hits_.size(); ++i) {
        const Hit& hit = hits_[i];
        if (!hit) continue;
        const Vec3 direction = rayQueue_[i].direction;
        const Vec3 geometric = geometricNormal(scene_, hit.triangle);
        const bool front = glm::dot(geometric, direction) < 0;
        const TriangleCharts& charts = unwrap_.triangleCharts[hit.triangle];
        const std::uint32_t chart = front ? charts.front : charts.back;
        if (chart == kNoChart) continue;
        Path path = paths_[i];
        const Material& material = scene_.material(hit.triangle);
        const Vec3 p = positionAt(scene_, hit.triangle, hit.barycentric);
        const Vec2 uv = uvAt(scene_, hit.triangle, hit.barycentric);
        if (reflections > 0) {
            Vec3 seen = radiance.rgb(texelAt(unwrap_, chart, p));
            if (material.isEmitter() && (front || material.emitsBothSides) &&
                !sources_.covers(reflections, path.planarOnly))
                seen += emittedRadiance(scene_, material, uv);
            gathered.addRgb(path.receiver, path.throughput * seen);
        }
        if (!material.isMirror()) continue;
        path.throughput *= mirrorReflectance(scene_, material, uv);
        path.planarOnly = path.planarOnly && sources_.planarMirror[chart];
        if (maxComponent(path.throughput) < kMinThroughput) continue;
        const Vec3 side = front ? geometric : -geometric;
        Vec3 normal = sources_.planarMirror[chart]
                          ? side
                          : shadingNormalAt(scene_, hit.triangle, hit.barycentric);
        if (glm::dot(normal, side) < 0) normal = -normal;
        const Vec3 reflected = glm::reflect(direction, normal);
        if (glm::dot(reflected, side) <= 0) continue;
        nextRays_.push_back({p + rays_.epsilon() * side, reflected});
        nextPaths_.push_back(path);
    }
    std::swap(paths_, nextPaths_);
    std::swap(rayQueue_, nextRays_);
}

void MirrorGatherer::gather(const ParallelSubfield& subfield,
                            const std::vector<MirrorSight>& sights, const TexelBuffer& radiance,
                            TexelBuffer& gathered) {
    if (sights.empty()) return;
    start(subfield, sights);
    for (int reflections = 0; reflections <= kMaxReflections && !rayQueue_.empty(); ++reflections)
        advance(reflections, radiance, gathered);
}

}  // namespace vlf
