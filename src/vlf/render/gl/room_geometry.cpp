#include "vlf/render/gl/room_geometry.h"

#include "vlf/render/gl/octahedron.h"

#include <map>
#include <tuple>
#include <unordered_map>

namespace vlf {

namespace {

/// One side of a triangle.
struct Side {
    std::uint32_t triangle;
    std::uint32_t chart;
    bool front;
    bool cull;
};

class GeometryMaker {
  public:
    GeometryMaker(const Scene& scene, const LightField& field) : scene_(scene), field_(field) {
        for (std::uint32_t c = 0; c < field.charts.size(); ++c)
            if (scene.materials[field.charts[c].material].isMirror()) {
                mirrorOf_.emplace(c, static_cast<std::uint32_t>(room_.mirrorCharts.size()));
                room_.mirrorCharts.push_back(c);
            }
    }

    RoomGeometry make() {
        for (const auto& [key, sides] : sortSides()) addBatch(sides);
        return std::move(room_);
    }

  private:
    // Mirrors last; otherwise what shares its state stays together.
    using Key = std::tuple<bool, std::uint32_t, bool, bool, bool>;

    std::map<Key, std::vector<Side>> sortSides() const {
        std::map<Key, std::vector<Side>> sides;
        for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
            const TriangleCharts& charts = field_.triangleCharts[t];
            const bool both = charts.front != kNoChart && charts.back != kNoChart;
            const auto add = [&](std::uint32_t chart, bool front) {
                const std::uint32_t material = scene_.triangles[t].material;
                const bool mirror = chart != kNoChart && scene_.materials[material].isMirror();
                sides[{mirror, material, front, both, chart == kNoChart}].push_back(
                    {t, chart, front, both});
            };
            if (charts.front != kNoChart || charts.back == kNoChart) add(charts.front, true);
            if (charts.back != kNoChart) add(charts.back, false);
        }
        return sides;
    }

    void addBatch(const std::vector<Side>& sides) {
        const Side& first = sides.front();
        const Material& material = scene_.material(first.triangle);
        RoomBatch batch;
        batch.material = scene_.triangles[first.triangle].material;
        batch.mirror = first.chart != kNoChart && material.isMirror();
        batch.cull = first.cull;
        const bool emits = first.front || material.emitsBothSides;
        const float lit = first.chart == kNoChart ? 0 : 1;
        batch.data.diffuse = Vec4(lit * material.diffuse, 0);
        batch.data.mirror = Vec4(lit * material.mirror, 0);
        batch.data.emission = Vec4((emits ? lit : 0) * material.emission, 0);
        batch.data.flags = Vec4(first.cull ? 0 : 1, room_.mirrorTriangles.size(), 0, 0);
        batch.firstIndex = static_cast<std::uint32_t>(room_.indices.size());
        shared_.clear();
        for (const Side& side : sides) addSide(side, batch.mirror);
        batch.indexCount = static_cast<std::uint32_t>(room_.indices.size()) - batch.firstIndex;
        room_.batches.push_back(batch);
    }

    void addSide(const Side& side, bool mirror) {
        if (mirror) room_.mirrorTriangles.push_back(side.triangle);
        for (int i = 0; i < 3; ++i) {
            const int corner = side.front ? i : 2 - i;
            const std::uint32_t vertex = scene_.triangles[side.triangle].vertex[corner];
            const auto next = static_cast<std::uint32_t>(room_.vertices.size());
            const std::uint64_t key = std::uint64_t{vertex} << 32 | side.chart;
            // Each triangle of a mirror has its own vertices, which hold its normal.
            const std::uint32_t index =
                mirror ? next : shared_.try_emplace(key, next).first->second;
            room_.indices.push_back(index);
            if (index == next) room_.vertices.push_back(makeVertex(side, vertex, mirror));
        }
    }

    RoomVertex makeVertex(const Side& side, std::uint32_t vertex, bool mirror) const {
        RoomVertex v;
        v.position = scene_.positions[vertex];
        v.uv = {scene_.uvs[vertex].x, 1 - scene_.uvs[vertex].y};
        if (side.chart == kNoChart) return v;
        const Chart& chart = field_.charts[side.chart];
        v.atlasUv = (Vec2(chart.x, chart.y) + chart.texelCoordinates(v.position)) /
                    Vec2(field_.atlas.width, field_.atlas.height);
        if (!mirror) return v;
        const float sign = side.front ? 1.0f : -1.0f;
        v.geometricNormal = toOctahedron(sign * geometricNormal(scene_, side.triangle));
        v.mirrorNormal =
            chart.planar ? v.geometricNormal : toOctahedron(sign * scene_.normals[vertex]);
        v.mirror = mirrorOf_.at(side.chart);
        return v;
    }

    const Scene& scene_;
    const LightField& field_;
    RoomGeometry room_;
    std::unordered_map<std::uint32_t, std::uint32_t> mirrorOf_;
    std::unordered_map<std::uint64_t, std::uint32_t> shared_;
};

}  // namespace

RoomGeometry makeRoomGeometry(const Scene& scene, const LightField& field) {
    return GeometryMaker(scene, field).make();
}

}  // namespace vlf
