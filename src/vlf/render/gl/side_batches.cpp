#include "vlf/render/gl/side_batches.h"

#include <map>
#include <tuple>
#include <utility>

namespace vlf {

namespace {

bool mirrors(const Scene& scene, const Side& side) {
    return side.chart != kNoChart && scene.material(side.triangle).isSpecular();
}

}  // namespace

std::vector<std::vector<Side>> sortSides(const Scene& scene,
                                         std::span<const TriangleCharts> charts) {
    // Mirrors last; otherwise what shares its state stays together.
    using Key = std::tuple<bool, std::uint32_t, bool, bool, bool>;
    std::map<Key, std::vector<Side>> sides;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const auto [front, back] = charts[t];
        const bool both = front != kNoChart && back != kNoChart;
        const auto add = [&](const Side& side) {
            sides[{mirrors(scene, side), scene.triangles[t].material, side.front, both,
                   side.chart == kNoChart}]
                .push_back(side);
        };
        if (front != kNoChart || back == kNoChart) add({t, front, true, both});
        if (back != kNoChart) add({t, back, false, both});
    }
    std::vector<std::vector<Side>> sorted;
    for (auto& [key, of] : sides) sorted.push_back(std::move(of));
    return sorted;
}

RoomBatch batchOf(const Scene& scene, const Side& side, std::size_t firstIndex) {
    const Material& material = scene.material(side.triangle);
    RoomBatch batch;
    batch.material = scene.triangles[side.triangle].material;
    batch.mirror = mirrors(scene, side) && !material.isGlossy();
    batch.rough = mirrors(scene, side) && material.isGlossy();
    batch.glass = side.chart != kNoChart && material.isGlass();
    batch.pane = batch.glass && material.thin;
    batch.cull = side.cull;
    const bool emits = side.front || material.emitsBothSides;
    const float lit = side.chart == kNoChart ? 0 : 1;
    batch.data.diffuse = Vec4(lit * material.diffuse, 0);
    batch.data.mirror = Vec4(lit * material.mirror, 0);
    batch.data.emission = Vec4((emits ? lit : 0) * material.emission, 0);
    batch.data.glass = Vec4(material.transmission, material.ior);
    batch.data.flags = Vec4(side.cull ? 0 : 1, 0, 0, 0);
    batch.firstIndex = static_cast<std::uint32_t>(firstIndex);
    return batch;
}

}  // namespace vlf
