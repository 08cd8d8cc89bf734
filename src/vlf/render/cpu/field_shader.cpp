#include "vlf/render/cpu/field_shader.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vlf {

namespace {

/// Longest chain of mirrors followed, as in the bake.
constexpr int kMaxReflections = 16;
constexpr float kMinThroughput = 1e-4f;

bool hasMirrors(const Scene& scene) {
    return std::any_of(scene.triangles.begin(), scene.triangles.end(),
                       [&](const Triangle& t) { return scene.materials[t.material].isMirror(); });
}

}  // namespace

/// A chain of reflections from the eye.
struct FieldShader::Path {
    std::size_t ray;  ///< of the camera
    Vec3 throughput;
};

struct FieldShader::Queue {
    std::vector<Path> paths;
    std::vector<Ray> rays;

    void add(const Path& path, const Ray& ray) {
        paths.push_back(path);
        rays.push_back(ray);
    }
    void clear() {
        paths.clear();
        rays.clear();
    }
};

std::uint32_t chartAt(const LightField& field, const SidePoint& point) {
    const TriangleCharts& charts = field.triangleCharts[point.triangle];
    return point.front ? charts.front : charts.back;
}

FieldShader::FieldShader(const Scene& scene, const RayScene& rays, const LightField& field,
                         MirrorMethod mirrors, LookupKind lookup)
    : scene_(scene), rays_(rays), field_(field), lookup_(lookup) {
    if (field.triangleCharts.size() != scene.triangles.size())
        throw InputError("the light field belongs to another scene: bake this one");
    if (mirrors == MirrorMethod::traced || !hasMirrors(scene)) return;
    if (field.radiance.empty())
        throw InputError(
            "the light field holds no radiance of mirrors to look up: bake with "
            "radiance directions, or trace reflections (mode raytraced)");
    lookedUp_.emplace(field);
}

std::uint64_t FieldShader::radiance(std::span<const Ray> rays, std::span<Vec3> radiance) const {
    std::fill(radiance.begin(), radiance.end(), Vec3(0));
    Queue queue, next;
    for (std::size_t i = 0; i < rays.size(); ++i) queue.add({i, Vec3(1)}, rays[i]);
    std::vector<Hit> hits;
    std::uint64_t traced = 0;
    for (int reflections = 0; reflections <= kMaxReflections && !queue.rays.empty();
         ++reflections) {
        hits.resize(queue.rays.size());
        rays_.closest(queue.rays, hits);
        traced += hits.size();
        for (std::size_t i = 0; i < hits.size(); ++i)
            if (hits[i]) follow(queue.paths[i], queue.rays[i], hits[i], radiance, next);
        std::swap(queue, next);
        next.clear();
    }
    return traced;
}

void FieldShader::follow(const Path& path, const Ray& ray, const Hit& hit, std::span<Vec3> radiance,
                         Queue& next) const {
    const SidePoint point = pointFacing(scene_, hit, ray.direction);
    const std::uint32_t chartIndex = chartAt(field_, point);
    if (chartIndex == kNoChart) return;
    const Chart& chart = field_.charts[chartIndex];
    Surface surface = surfaceAt(scene_, point);
    Vec3& seen = radiance[path.ray];
    seen += path.throughput * ownRadiance(surface, chart);
    const Vec3 throughput = path.throughput * surface.mirror;
    if (maxComponent(throughput) < kMinThroughput) return;
    if (lookedUp_) {
        const MirrorPoint mirror{chartIndex, surface.position, surface.geometricNormal};
        seen += path.throughput * lookedUp_->mirrorRadiance(mirror, -ray.direction, lookup_);
        return;
    }
    if (chart.planar) surface.normal = surface.geometricNormal;
    next.add({path.ray, throughput}, {surface.position + rays_.epsilon() * surface.geometricNormal,
                                      mirrorDirection(surface, ray.direction)});
}

/// Radiance that leaves a surface by emission and diffuse reflection.
Vec3 FieldShader::ownRadiance(const Surface& surface, const Chart& chart) const {
    const Vec3 irradiance = field_.atlas.sample(chart, chart.texelCoordinates(surface.position));
    return emittedRadiance(scene_, surface.point) + surface.diffuse * irradiance / kPi;
}

}  // namespace vlf
