#include "vlf/dynamic/rebake.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/posed_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vlf {

namespace {

/// Places of one side of a triangle that lie on the middles of its chart's texels.
template <class Visit>
void forTexels(const Scene& scene, std::uint32_t triangle, const Chart& chart, const Visit& visit) {
    const Vec2 a = chart.texelCoordinates(scene.position(triangle, 0));
    const Vec2 ab = chart.texelCoordinates(scene.position(triangle, 1)) - a;
    const Vec2 ac = chart.texelCoordinates(scene.position(triangle, 2)) - a;
    const float det = ab.x * ac.y - ab.y * ac.x;
    if (std::abs(det) < 1e-12f) return;
    const Vec2 lower = glm::floor(a + glm::min(glm::min(ab, ac), Vec2(0)));
    const Vec2 upper = glm::ceil(a + glm::max(glm::max(ab, ac), Vec2(0)));
    for (float y = lower.y; y < upper.y; ++y)
        for (float x = lower.x; x < upper.x; ++x) {
            const Vec2 middle(x + 0.5f, y + 0.5f), p = middle - a;
            const Vec2 barycentric((p.x * ac.y - p.y * ac.x) / det,
                                   (ab.x * p.y - ab.y * p.x) / det);
            if (barycentric.x >= 0 && barycentric.y >= 0 && barycentric.x + barycentric.y < 1)
                visit(middle, positionAt(scene, triangle, barycentric));
        }
}

/// Whether a point just above a surface lies within a closed object.
bool buried(const DynamicRoom& room, const Vec3& position, const Vec3& normal, float epsilon) {
    const Ray up{position + epsilon * normal, normal};
    const InstanceHit hit = room.rays().closest(up);
    if (!hit) return false;
    const LitObject& object = room.litObjects()[hit.instance];
    const Vec3 front = areaVector(object.mesh->scene, hit.hit.triangle);
    return object.mesh->closed && glm::dot(object.pose.direction(front), normal) > 0;
}

struct TexelPair {
    Vec3 still, dynamic, rebaked;
};

void addTexels(const DynamicRoom& room, const RayScene& rays, const LightField& rebaked,
               std::uint32_t triangle, bool front, std::vector<TexelPair>& pairs) {
    if (room.scene().material(triangle).isEmitter()) return;
    const TriangleCharts& charts = room.field().triangleCharts[triangle];
    const TriangleCharts& others = rebaked.triangleCharts[triangle];
    const std::uint32_t index = front ? charts.front : charts.back;
    const std::uint32_t other = front ? others.front : others.back;
    if (index == kNoChart || other == kNoChart) return;
    const Chart& chart = room.field().charts[index];
    const Chart& otherChart = rebaked.charts[other];
    const Vec3 normal = geometricNormal(room.scene(), triangle) * (front ? 1.0f : -1.0f);
    forTexels(room.scene(), triangle, chart, [&](const Vec2& texel, const Vec3& position) {
        if (buried(room, position, normal, rays.epsilon()) ||
            isConcealed(room.scene(), rays, room.field().triangleCharts, triangle, front, position,
                        chart.texelSize()))
            return;
        pairs.push_back({room.roomIrradiance().sample(chart, texel),
                         room.irradiance().sample(chart, texel),
                         rebaked.atlas.sample(otherChart, otherChart.texelCoordinates(position))});
    });
}

double square(const Vec3& v) {
    return static_cast<double>(glm::dot(v, v));
}

double relative(double error, double value) {
    return value > 0 ? std::sqrt(error / value) : 0;
}

}  // namespace

BakeParams paramsOf(const BakeRecord& record) {
    BakeParams p = presetParams(record.preset.empty() ? "standard" : record.preset);
    p.directions = record.directions;
    p.cells = record.cells;
    p.texelSize = record.texelSize;
    p.directSamples = record.directSamples;
    p.radianceDirections = record.radianceDirections;
    if (record.radianceCells > 0) p.radianceCells = record.radianceCells;
    if (record.tileSize > 0) p.tileSize = record.tileSize;
    p.seed = record.seed;
    return p;
}

RebakedRoom rebake(const DynamicRoom& room, const BakeParams& params, Progress& progress) {
    std::vector<DynamicObject> objects;
    for (std::size_t i = 0; i < room.size(); ++i) objects.push_back(room.object(i));
    RebakedRoom rebaked;
    rebaked.scene = posedScene(room.scene(), objects);
    rebaked.field = bake(rebaked.scene, params, progress);
    return rebaked;
}

bool isConcealed(const Scene& scene, const RayScene& rays,
                 std::span<const TriangleCharts> triangleCharts, std::uint32_t triangle, bool front,
                 const Vec3& position, float gap) {
    const Vec3 normal = geometricNormal(scene, triangle) * (front ? 1.0f : -1.0f);
    const Hit hit = rays.closest({position + rays.epsilon() * normal, normal});
    if (!hit) return false;
    const TriangleCharts& charts = triangleCharts[hit.triangle];
    const bool hitsFront = glm::dot(geometricNormal(scene, hit.triangle), normal) < 0;
    return hit.t < gap || (hitsFront ? charts.front : charts.back) == kNoChart;
}

RoomLightError compareRoomLight(const DynamicRoom& room, const LightField& rebaked) {
    const Scene& scene = room.scene();
    const RayScene rays(scene);
    std::vector<std::vector<TexelPair>> pairs(scene.triangles.size());
    parallelFor(pairs.size(), 16, [&](std::size_t t) {
        for (const bool front : {true, false})
            addTexels(room, rays, rebaked, static_cast<std::uint32_t>(t), front, pairs[t]);
    });

    RoomLightError error;
    double sum = 0;
    for (const auto& part : pairs)
        for (const TexelPair& p : part) sum += luminance(p.still), ++error.texels;
    const float mean =
        static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(error.texels, 1)));
    double all = 0, truth = 0, changedError = 0, change = 0, noise = 0, still = 0;
    for (const auto& part : pairs)
        for (const TexelPair& p : part) {
            const double off = square(p.dynamic - p.rebaked), by = square(p.rebaked - p.still);
            all += off, truth += square(p.rebaked);
            const float least = RoomLightError::kChanged * std::max(luminance(p.still), mean);
            if (std::max(luminance(glm::abs(p.dynamic - p.still)),
                         luminance(glm::abs(p.rebaked - p.still))) > least) {
                ++error.changedTexels;
                changedError += off, change += by;
            } else {
                noise += by, still += square(p.still);
            }
        }
    error.relativeRmse = relative(all, truth);
    error.changeError = relative(changedError, change);
    error.noise = relative(noise, still);
    return error;
}

}  // namespace vlf
