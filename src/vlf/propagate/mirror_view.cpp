#include "vlf/propagate/mirror_view.h"

#include "vlf/propagate/ray_gather.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr float kMinThroughput = 1e-4f;
constexpr float kMinCosine = 0.05f;
constexpr float kInset = 1e-3f;  // of the way to the middle of a triangle

/// About the geometric normal `side` where the shading normal would send the ray into the surface.
Vec3 reflectAbove(const Vec3& direction, const Vec3& normal, const Vec3& side) {
    const Vec3 reflected = glm::reflect(direction, normal);
    return glm::dot(reflected, side) > 0 ? reflected : glm::reflect(direction, side);
}

Vec3 sideNormal(const Scene& scene, std::uint32_t triangle, bool front) {
    return geometricNormal(scene, triangle) * (front ? 1.0f : -1.0f);
}

/// The shading normal on the given side; of planar charts the plane's.
Vec3 mirrorNormal(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric,
                  const Vec3& side, bool planar) {
    if (planar) return side;
    const Vec3 normal = shadingNormalAt(scene, triangle, barycentric);
    return glm::dot(normal, side) < 0 ? -normal : normal;
}

/// Mean curvature that a triangle's shading normals give it, positive where they spread.
float curvatureOf(const Scene& scene, std::uint32_t triangle, bool front) {
    const auto& v = scene.triangles[triangle].vertex;
    float spread = 0, extent = 0;
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t a = v[i], b = v[(i + 1) % 3];
        const Vec3 step = scene.positions[b] - scene.positions[a];
        spread += glm::dot(scene.normals[b] - scene.normals[a], step);
        extent += glm::dot(step, step);
    }
    return (front ? spread : -spread) / extent;
}

}  // namespace

float imageDistance(float d, float curvature, float cosine, float longest) {
    const float vergence = 1 / d + curvature * (1 / cosine + cosine);
    return vergence * longest > 1 ? 1 / vergence : longest;
}

/// Where a ray has hit the side of a chart.
struct MirrorViewTracer::Arrival {
    const Hit& hit;
    const Chart& chart;
    const Material& material;
    bool front;
    Vec3 position;
    Vec2 uv;
};

void MirrorViewTracer::start(bool planar) {
    views_.assign(cells_.size(), {});
    paths_.clear();
    rayQueue_.clear();
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
        const MirrorCell& c = cells_[i];
        const Vec3 side = sideNormal(scene_, c.triangle, c.front);
        const Vec3 normal = mirrorNormal(scene_, c.triangle, c.barycentric, side, planar);
        const Vec2 uv = uvAt(scene_, c.triangle, c.barycentric);
        const Vec3 mirror = mirrorReflectance(scene_, scene_.material(c.triangle), uv);
        rayQueue_.push_back(
            {c.position + rays_.epsilon() * side, reflectAbove(-toEye_, normal, side)});
        paths_.push_back({i, mirror, 0, true, true});
    }
}

Vec3 MirrorViewTracer::radianceSeen(const Arrival& at) const {
    const Vec3 irradiance = field_.atlas.sample(at.chart, at.chart.texelCoordinates(at.position));
    Vec3 radiance = diffuseReflectance(scene_, at.material, at.uv) * irradiance / kPi;
    if (at.material.isEmitter() && (at.front || at.material.emitsBothSides))
        radiance += emittedRadiance(scene_, at.material, at.uv);
    return radiance;
}

void MirrorViewTracer::reflect(Path path, const Vec3& direction, const Arrival& at) {
    path.throughput *= mirrorReflectance(scene_, at.material, at.uv);
    if (maxComponent(path.throughput) < kMinThroughput) return;
    path.unfolding = path.unfolding && at.chart.planar &&
                     maxComponent(at.material.mirror) > maxComponent(at.material.diffuse);
    path.first = false;
    const Vec3 side = sideNormal(scene_, at.hit.triangle, at.front);
    const Vec3 normal =
        mirrorNormal(scene_, at.hit.triangle, at.hit.barycentric, side, at.chart.planar);
    nextRays_.push_back(
        {at.position + rays_.epsilon() * side, reflectAbove(direction, normal, side)});
    nextPaths_.push_back(path);
}

std::uint32_t MirrorViewTracer::chartHit(const Ray& ray, const Hit& hit) const {
    const bool front = glm::dot(areaVector(scene_, hit.triangle), ray.direction) < 0;
    const TriangleCharts& sides = field_.triangleCharts[hit.triangle];
    return front ? sides.front : sides.back;
}

/// Starts a guard cell again from the chart's point next to it.
void MirrorViewTracer::restart(Path path, const Ray& ray) {
    const MirrorCell& cell = cells_[path.cell];
    const Vec2 inset = cell.barycentric + kInset * (Vec2(1.0f / 3) - cell.barycentric);
    const Vec3 side = sideNormal(scene_, cell.triangle, cell.front);
    path.first = false;
    nextRays_.push_back(
        {positionAt(scene_, cell.triangle, inset) + rays_.epsilon() * side, ray.direction});
    nextPaths_.push_back(path);
}

/// Whether the inside of a solid or the outside of the room comes between p and the eye.
bool MirrorViewTracer::isHidden(const Vec3& p) const {
    const Ray ray{p, toEye_};
    const Hit hit = rays_.closest(ray);
    return hit && chartHit(ray, hit) == kNoChart;
}

void MirrorViewTracer::arrive(const Path& path, const Ray& ray, const Hit& hit) {
    MirrorView& view = views_[path.cell];
    const std::uint32_t chart = hit ? chartHit(ray, hit) : kNoChart;
    if (chart == kNoChart && path.first && cells_[path.cell].guard) return restart(path, ray);
    if (!hit && path.unfolding && !(path.length == 0 && isHidden(ray.origin)))
        view.distance = longest_;
    if (chart == kNoChart) return;
    const bool front = glm::dot(areaVector(scene_, hit.triangle), ray.direction) < 0;
    const Arrival at{hit,
                     field_.charts[chart],
                     scene_.material(hit.triangle),
                     front,
                     positionAt(scene_, hit.triangle, hit.barycentric),
                     uvAt(scene_, hit.triangle, hit.barycentric)};
    Path next = path;
    next.length += std::max(hit.t, rays_.epsilon());
    if (path.unfolding) view.distance = next.length;
    view.radiance += path.throughput * radianceSeen(at);
    if (at.material.isMirror()) reflect(next, ray.direction, at);
}

void MirrorViewTracer::advance() {
    hits_.resize(rayQueue_.size());
    rays_.closest(rayQueue_, hits_);
    nextPaths_.clear();
    nextRays_.clear();
    for (std::size_t i = 0; i < hits_.size(); ++i) arrive(paths_[i], rayQueue_[i], hits_[i]);
    std::swap(paths_, nextPaths_);
    std::swap(rayQueue_, nextRays_);
}

void MirrorViewTracer::formImages() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const MirrorCell& c = cells_[i];
        if (views_[i].distance <= 0) continue;
        const Vec3 side = sideNormal(scene_, c.triangle, c.front);
        const Vec3 normal = mirrorNormal(scene_, c.triangle, c.barycentric, side, false);
        const float cosine = std::max(glm::dot(normal, toEye_), kMinCosine);
        const float curvature = curvatureOf(scene_, c.triangle, c.front);
        views_[i].distance = imageDistance(views_[i].distance, curvature, cosine, longest_);
    }
}

const std::vector<MirrorView>& MirrorViewTracer::trace(std::span<const MirrorCell> cells,
                                                       const Vec3& toEye, bool planar) {
    cells_ = cells;
    toEye_ = toEye;
    start(planar);
    for (int step = 0; step <= kMaxReflections && !rayQueue_.empty(); ++step) advance();
    if (!planar) formImages();
    for (MirrorView& v : views_) v.distance = std::min(v.distance, longest_);
    return views_;
}

}  // namespace vlf
