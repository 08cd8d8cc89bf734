#include "vlf/dynamic/room_texels.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"

#include <utility>

namespace vlf {

namespace {

/// Mean diffuse reflectance over a texel's points.
Vec3 meanReflectance(const Scene& scene, std::span<const SurfacePoint> points) {
    const Material& material = scene.material(points[0].triangle);
    if (material.diffuseTexture < 0) return material.diffuse;
    Vec3 sum(0);
    for (const SurfacePoint& p : points)
        sum += diffuseReflectance(scene, material, uvAt(scene, p.triangle, p.barycentric));
    return sum / static_cast<float>(points.size());
}

/// Spreads the covered texels of one chart over the rest of it and its gutter, ring by ring.
void spread(const Chart& chart, std::uint32_t atlasWidth, std::vector<std::uint32_t>& source) {
    std::vector<std::uint32_t> front;
    const auto forEach = [&](auto visit) {
        for (std::uint32_t y = chart.y - kGutter; y < chart.y + chart.height + kGutter; ++y)
            for (std::uint32_t x = chart.x - kGutter; x < chart.x + chart.width + kGutter; ++x)
                visit(x, y);
    };
    forEach([&](std::uint32_t x, std::uint32_t y) {
        if (source[y * atlasWidth + x] != kNoTexel) front.push_back(y * atlasWidth + x);
    });
    while (!front.empty()) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t t : front)
            for (const auto& [dx, dy] :
                 {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
                const std::uint32_t x = t % atlasWidth + dx, y = t / atlasWidth + dy;
                if (x < chart.x - kGutter || y < chart.y - kGutter ||
                    x >= chart.x + chart.width + kGutter || y >= chart.y + chart.height + kGutter)
                    continue;
                std::uint32_t& found = source[y * atlasWidth + x];
                if (found != kNoTexel) continue;
                found = source[t];
                next.push_back(y * atlasWidth + x);
            }
        front = std::move(next);
    }
}

}  // namespace

RoomTexels makeRoomTexels(const Scene& scene, const RayScene& rays, const LightField& field) {
    if (field.triangleCharts.size() != scene.triangles.size())
        throw InputError("the light field belongs to another scene: bake this one");
    RoomTexels room;
    room.unwrap = restoreUnwrap(scene, rays, field.charts, field.triangleCharts,
                                {field.atlas.width, field.atlas.height});
    room.sources = findLightSources(scene, room.unwrap);
    room.frame = field.frame;
    const Unwrap& unwrap = room.unwrap;
    room.source.assign(unwrap.atlasSize(), kNoTexel);
    room.reflectance.assign(unwrap.atlasSize(), Vec3(0));
    room.area.assign(unwrap.atlasSize(), 0);
    parallelFor(unwrap.texels.size(), 512, [&](std::size_t i) {
        const std::uint32_t texel = unwrap.texels[i];
        room.source[texel] = texel;
        room.reflectance[texel] = meanReflectance(scene, unwrap.points.of(i));
        room.area[texel] = unwrap.texelArea(i);
    });
    parallelFor(unwrap.charts.size(), 16,
                [&](std::size_t c) { spread(unwrap.charts[c], unwrap.atlasWidth, room.source); });
    return room;
}

}  // namespace vlf
