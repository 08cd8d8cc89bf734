#include "vlf/render/gl/object_geometry.h"

#include "vlf/render/gl/octahedron.h"

#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace vlf {

namespace {

/// One side of a triangle.
struct Side {
    std::uint32_t triangle;
    std::uint32_t chart;
    bool front;
    bool cull;
};

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
        for (const auto& [key, sides] : sortSides()) addBatch(sides);
        made_.surfaces = makeHitSurfaces(scene_, texels_.charts, texels_.triangleCharts);
        made_.bvh = buildBvh(scene_);
        made_.bounds = boundingSphere(scene_);
        return std::move(made_);
    }

  private:
    using Key = std::tuple<bool, std::uint32_t, bool, bool, bool>;

    std::map<Key, std::vector<Side>> sortSides() const {
        std::map<Key, std::vector<Side>> sides;
        for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
            const TriangleCharts& charts = texels_.triangleCharts[t];
            const bool both = charts.front != kNoChart && charts.back != kNoChart;
            const std::uint32_t material = scene_.triangles[t].material;
            const bool mirror = scene_.materials[material].isMirror();
            const auto add = [&](std::uint32_t chart, bool front) {
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
        const float lit = first.chart == kNoChart ? 0 : 1;
        const bool emits = first.front || material.emitsBothSides;
        batch.data.diffuse = Vec4(lit * material.diffuse, 0);
        batch.data.mirror = Vec4(lit * material.mirror, 0);
        batch.data.emission = Vec4((emits ? lit : 0) * material.emission, 0);
        batch.data.flags = Vec4(first.cull ? 0 : 1, 0, 0, 0);
        batch.firstIndex = static_cast<std::uint32_t>(made_.indices.size());
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
