#include "vlf/render/gl/object_geometry.h"

#include "vlf/render/gl/octahedron.h"
#include "vlf/render/gl/side_batches.h"

#include <unordered_map>
#include <utility>

namespace vlf {

namespace {

/// Charts that only say which material a side has: one a material.
ObjectTexels materialCharts(const ObjectMesh& mesh) {
    ObjectTexels texels;
    texels.charts.resize(mesh.scene.materials.size());
    for (std::uint32_t m = 0; m < texels.charts.size(); ++m) texels.charts[m].material = m;
    for (const Triangle& t : mesh.scene.triangles)
        texels.triangleCharts.push_back({t.material, mesh.closed ? kNoChart : t.material});
    return texels;
}

class ObjectMaker {
  public:
    ObjectMaker(const ObjectMesh& mesh, const ObjectTexels& texels)
        : mesh_(mesh), scene_(mesh.scene), texels_(texels) {}

    ObjectGeometry make() {
        for (const auto& sides : sortSides(scene_, texels_.triangleCharts)) addBatch(sides);
        made_.surfaces = makeHitSurfaces(scene_, texels_.charts, texels_.triangleCharts);
        made_.bvh = buildBvh(scene_);
        made_.bounds = boundingSphere(scene_);
        return std::move(made_);
    }

  private:
    void addBatch(const std::vector<Side>& sides) {
        RoomBatch batch = batchOf(scene_, sides.front(), made_.indices.size());
        shared_.clear();
        for (const Side& side : sides) addSide(side);
        batch.indexCount = static_cast<std::uint32_t>(made_.indices.size()) - batch.firstIndex;
        made_.batches.push_back(batch);
    }

    void addSide(const Side& side) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t vertex =
                scene_.triangles[side.triangle].vertex[side.front ? i : 2 - i];
            const auto next = static_cast<std::uint32_t>(made_.vertices.size());
            const std::uint64_t key = std::uint64_t{vertex} << 32 | side.chart;
            const std::uint32_t index = shared_.try_emplace(key, next).first->second;
            made_.indices.push_back(index);
            if (index == next) made_.vertices.push_back(makeVertex(side, vertex));
        }
    }

    RoomVertex makeVertex(const Side& side, std::uint32_t vertex) const {
        RoomVertex v;
        v.position = scene_.positions[vertex];
        v.uv = {scene_.uvs[vertex].x, 1 - scene_.uvs[vertex].y};
        v.mirrorNormal = toOctahedron((side.front ? 1.0f : -1.0f) * scene_.normals[vertex]);
        const std::size_t firstOfSide = side.front || mesh_.closed ? 0 : scene_.positions.size();
        v.mirror = static_cast<std::uint32_t>(firstOfSide + vertex);
        if (side.chart == kNoChart) return v;
        const Chart& chart = texels_.charts[side.chart];
        v.atlasUv = Vec2(chart.x, chart.y) + chart.texelCoordinates(v.position);
        return v;
    }

    const ObjectMesh& mesh_;
    const Scene& scene_;
    const ObjectTexels& texels_;
    ObjectGeometry made_;
    std::unordered_map<std::uint64_t, std::uint32_t> shared_;
};

}  // namespace

ObjectGeometry makeObjectGeometry(const ObjectMesh& mesh, const ObjectTexels* texels) {
    if (texels) return ObjectMaker(mesh, *texels).make();
    return ObjectMaker(mesh, materialCharts(mesh)).make();
}

}  // namespace vlf
