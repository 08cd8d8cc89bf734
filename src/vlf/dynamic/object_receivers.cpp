#include "vlf/dynamic/object_receivers.h"

#include "vlf/dynamic/spread_texels.h"

#include <algorithm>

namespace vlf {

namespace {

void addVertices(const ObjectMesh& mesh, ObjectReceivers& out) {
    const Scene& scene = mesh.scene;
    const std::size_t count = scene.positions.size();
    constexpr Vec2 kCorner[3] = {{0, 0}, {1, 0}, {0, 1}};
    std::vector<Vec3> around(count, Vec3(0));
    out.points.points.resize(mesh.sidedVertexCount());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t v = scene.triangles[t].vertex[c];
            around[v] += areaVector(scene, t);
            out.points.points[v] = {t, kCorner[c]};
        }
    for (std::size_t i = 0; i < mesh.sidedVertexCount(); ++i) {
        const std::size_t v = i % count;
        const float side = i < count ? 1.0f : -1.0f;
        const float length = glm::length(around[v]);
        const Vec3 geometric = length > 0 ? around[v] / length : scene.normals[v];
        const Vec3 normal =
            glm::dot(scene.normals[v], geometric) < 0 ? -scene.normals[v] : scene.normals[v];
        out.points.points[i] = out.points.points[v];
        out.position.push_back(scene.positions[v]);
        out.geometric.push_back(side * geometric);
        out.normal.push_back(side * normal);
    }
    const std::span<const SurfacePoint> points = out.points.points;
    for (std::size_t i = 0; i < out.size(); ++i) {
        LightReceiver light;
        light.scene = &scene;
        light.points = points.subspan(i, 1);
        light.centre = out.position[i];
        light.normal = out.normal[i];
        light.side = i < count ? 1.0f : -1.0f;
        light.key = i;
        out.light.push_back(light);
    }
}

/// Mean position and normals over a texel's points.
void addTexel(const ObjectMesh& mesh, std::size_t i, ObjectReceivers& out) {
    const Unwrap& unwrap = *out.unwrap;
    const LightReceiver light = texelReceiver(mesh.scene, unwrap, i);
    Vec3 normal(0), geometric(0);
    for (const SurfacePoint& p : light.points) {
        const Vec3 g = light.side * geometricNormal(mesh.scene, p.triangle);
        const Vec3 n = shadingNormalAt(mesh.scene, p.triangle, p.barycentric);
        geometric += g;
        normal += glm::dot(n, g) < 0 ? -n : n;
    }
    // The point nearest to the middle: the middle itself may lie off a curved surface.
    Vec3 position = light.centre;
    if (!light.planar) {
        float least = std::numeric_limits<float>::max();
        for (const SurfacePoint& p : light.points) {
            const Vec3 q = positionAt(mesh.scene, p.triangle, p.barycentric);
            const float distance = glm::distance(q, light.centre);
            if (distance < least) least = distance, position = q;
        }
    }
    const Vec3& chartNormal = light.normal;
    const auto unit = [&](const Vec3& v) {
        return glm::length(v) > 1e-6f ? glm::normalize(v) : chartNormal;
    };
    out.position.push_back(position);
    out.normal.push_back(unit(normal));
    out.geometric.push_back(unit(geometric));
    out.light.push_back(light);
}

void addTexels(const ObjectModel& model, float texelSize, int budget, ObjectReceivers& out) {
    const ObjectMesh& mesh = model.mesh();
    out.unwrap = std::make_unique<const Unwrap>(unwrapObject(model, texelSize, budget));
    const Unwrap& unwrap = *out.unwrap;
    out.texels = {unwrap.charts, unwrap.triangleCharts};
    out.source.assign(unwrap.atlasSize(), ObjectReceivers::kNone);
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i) {
        addTexel(mesh, i, out);
        out.source[unwrap.texels[i]] = static_cast<std::uint32_t>(i);
    }
    for (const Chart& chart : unwrap.charts)
        spreadOverChart(chart, unwrap.atlasWidth, ObjectReceivers::kNone, out.source);
}

}  // namespace

std::uint32_t ObjectReceivers::at(std::uint32_t triangle, const Vec2& b, bool front) const {
    if (areTexels()) {
        const TriangleCharts& charts = texels.triangleCharts[triangle];
        const std::uint32_t c = front ? charts.front : charts.back;
        if (c == kNoChart) return kNone;
        const Chart& chart = texels.charts[c];
        const Vec2 t = chart.texelCoordinates(positionAt(mesh->scene, triangle, b));
        const auto x = static_cast<std::uint32_t>(std::clamp(t.x, 0.0f, chart.width - 1.0f));
        const auto y = static_cast<std::uint32_t>(std::clamp(t.y, 0.0f, chart.height - 1.0f));
        return source[(chart.y + y) * unwrap->atlasWidth + chart.x + x];
    }
    if (!front && mesh->closed) return kNone;
    const float first = 1 - b.x - b.y;
    const int corner = first >= b.x && first >= b.y ? 0 : b.x >= b.y ? 1 : 2;
    const std::uint32_t vertex = mesh->scene.triangles[triangle].vertex[corner];
    return front ? vertex : vertex + static_cast<std::uint32_t>(mesh->scene.positions.size());
}

Unwrap unwrapObject(const ObjectModel& model, float texelSize, int texels) {
    const ObjectMesh& mesh = model.mesh();
    UnwrapParams params;
    params.texelSize = texelSize;
    params.texelBudget = texels;
    params.sides = OpenSides{true, !mesh.closed};
    return unwrap(mesh.scene, mesh.rays, params);
}

std::unique_ptr<const ObjectReceivers> makeReceivers(const ObjectModel& model,
                                                     const GatherSettings& settings, int budget) {
    auto receivers = std::make_unique<ObjectReceivers>();
    const bool texels = settings.points == GatherPoints::texels;
    receivers->mesh = &model.mesh(texels ? 0 : settings.subdivision);
    if (texels)
        addTexels(model, settings.texelSize, budget, *receivers);
    else
        addVertices(*receivers->mesh, *receivers);
    for (const LightReceiver& light : receivers->light)
        receivers->reflectance.push_back(
            meanReflectance(receivers->mesh->scene, light.points).diffuse);
    return receivers;
}

}  // namespace vlf
