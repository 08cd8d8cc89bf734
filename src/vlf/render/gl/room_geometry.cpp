#include "vlf/render/gl/room_geometry.h"

#include "vlf/render/gl/octahedron.h"
#include "vlf/render/gl/side_batches.h"

#include <unordered_map>

namespace vlf {

namespace {

class GeometryMaker {
  public:
    GeometryMaker(const Scene& scene, const LightField& field) : scene_(scene), field_(field) {
        for (std::uint32_t c = 0; c < field.charts.size(); ++c) {
            const Material& material = scene.materials[field.charts[c].material];
            if (!material.isSpecular()) continue;
            auto& charts = material.isGlossy() ? room_.roughCharts : room_.mirrorCharts;
            mirrorOf_.emplace(c, static_cast<std::uint32_t>(charts.size()));
            charts.push_back(c);
        }
    }

    RoomGeometry make() {
        for (const auto& sides : sortSides(scene_, field_.triangleCharts)) addBatch(sides);
        return std::move(room_);
    }

  private:
    void addBatch(const std::vector<Side>& sides) {
        RoomBatch batch = batchOf(scene_, sides.front(), room_.indices.size());
        batch.data.flags.y = static_cast<float>(room_.mirrorTriangles.size());
        shared_.clear();
        for (const Side& side : sides) addSide(side, batch);
        batch.indexCount = static_cast<std::uint32_t>(room_.indices.size()) - batch.firstIndex;
        room_.batches.push_back(batch);
    }

    void addSide(const Side& side, const RoomBatch& batch) {
        const bool mirror = batch.mirror || batch.rough;
        if (batch.mirror) room_.mirrorTriangles.push_back(side.triangle);
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
