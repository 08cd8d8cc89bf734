#include "vlf/dynamic/room_texels.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/dynamic/spread_texels.h"

#include <algorithm>
#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace vlf {

namespace {

using CellPlace = std::tuple<std::uint32_t, int, int>;  ///< chart, place along u and v

/// Alike where none has any.
void shareByArea(std::span<const float> areas, TexelLattice::Corner& corner) {
    float sum = 0;
    for (int k = 0; k < corner.count; ++k) sum += areas[corner.cells[k]];
    for (int k = 0; k < corner.count; ++k)
        corner.shares[k] =
            sum > 0 ? areas[corner.cells[k]] / sum : 1.0f / static_cast<float>(corner.count);
}

TexelLattice makeLattice(const std::map<CellPlace, std::uint32_t>& cells,
                         std::span<const float> areas) {
    TexelLattice lattice;
    lattice.cornersOf.resize(areas.size());
    std::map<CellPlace, std::uint32_t> corners;
    for (const auto& [place, cell] : cells) {
        const auto& [chart, u, v] = place;
        for (int k = 0; k < 4; ++k) {
            const auto number = static_cast<std::uint32_t>(lattice.corners.size());
            const auto [found, isNew] =
                corners.try_emplace(CellPlace(chart, u + (k & 1), v + (k >> 1)), number);
            if (isNew) lattice.corners.emplace_back();
            TexelLattice::Corner& corner = lattice.corners[found->second];
            corner.cells[corner.count++] = cell;
            lattice.cornersOf[cell][k] = found->second;
        }
    }
    for (TexelLattice::Corner& corner : lattice.corners) shareByArea(areas, corner);
    return lattice;
}

/// Squares of RoomTexels::kGroupSide² texels of a chart.
void groupTexels(const Scene& scene, RoomTexels& room) {
    const Unwrap& unwrap = room.unwrap;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
    for (std::uint32_t i = 0; i < unwrap.texels.size(); ++i) {
        const Chart& chart = unwrap.charts[unwrap.texelChart[i]];
        const std::uint32_t x = unwrap.texels[i] % unwrap.atlasWidth - chart.x;
        const std::uint32_t y = unwrap.texels[i] / unwrap.atlasWidth - chart.y;
        const std::uint64_t square =
            std::uint64_t{y / RoomTexels::kGroupSide} << 16 | x / RoomTexels::kGroupSide;
        keyed.emplace_back(std::uint64_t{unwrap.texelChart[i]} << 32 | square, i);
    }
    room.groupOf.assign(unwrap.atlasSize(), 0);
    room.blockOf.assign(unwrap.atlasSize(), 0);
    std::stable_sort(keyed.begin(), keyed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t begin = 0, end = 0; begin < keyed.size(); begin = end) {
        TexelGroup group;
        group.first = static_cast<std::uint32_t>(begin);
        Bounds bounds;
        for (; end < keyed.size() && keyed[end].first == keyed[begin].first; ++end) {
            const std::uint32_t texel = unwrap.texels[keyed[end].second];
            room.grouped.push_back(keyed[end].second);
            room.groupOf[texel] = static_cast<std::uint32_t>(room.groups.size());
            if (room.hidden[texel])
                group.open = false;
            else
                group.area += room.area[texel];
            for (const SurfacePoint& p : unwrap.points.of(keyed[end].second))
                bounds.add(positionAt(scene, p.triangle, p.barycentric));
        }
        group.count = static_cast<std::uint32_t>(end - begin);
        group.bounds = {bounds.centre(), 0.5f * glm::length(bounds.size())};
        room.groups.push_back(group);
    }
    // A quarter of a group has the group's number times four and its place in it.
    room.blockArea.assign(4 * room.groups.size(), 0);
    room.blockReflects.assign(4 * room.groups.size(), Vec3(0));
    constexpr std::uint32_t kHalf = RoomTexels::kGroupSide / 2;
    room.placeOf.assign(unwrap.atlasSize(), 0);
    std::map<CellPlace, std::uint32_t> groups, blocks;
    for (std::uint32_t i = 0; i < unwrap.texels.size(); ++i) {
        const std::uint32_t texel = unwrap.texels[i];
        const Chart& chart = unwrap.charts[unwrap.texelChart[i]];
        const std::uint32_t x = texel % unwrap.atlasWidth - chart.x;
        const std::uint32_t y = texel / unwrap.atlasWidth - chart.y;
        room.blockOf[texel] = 4 * room.groupOf[texel] + y / kHalf % 2 * 2 + x / kHalf % 2;
        if (!room.hidden[texel]) {
            room.blockArea[room.blockOf[texel]] += room.area[texel];
            room.blockReflects[room.blockOf[texel]] += room.area[texel] * room.reflectance[texel];
        }
        constexpr std::uint32_t kSide = RoomTexels::kGroupSide;
        room.groups[room.groupOf[texel]].corner = texel - x % kSide - y % kSide * unwrap.atlasWidth;
        room.placeOf[texel] = static_cast<std::uint8_t>(x % kSide | y % kSide << 3);
        const std::uint32_t c = unwrap.texelChart[i];
        const std::uint32_t group = room.groupOf[texel], u = x / kSide, v = y / kSide;
        if (!groups.try_emplace(CellPlace(c, u, v), group).second) continue;
        for (std::uint32_t k = 0; k < 4; ++k)
            blocks.try_emplace(CellPlace(c, 2 * u + k % 2, 2 * v + k / 2), 4 * group + k);
    }
    std::vector<float> groupAreas;
    for (const TexelGroup& group : room.groups) groupAreas.push_back(group.area);
    room.groupLattice = makeLattice(groups, groupAreas);
    room.blockLattice = makeLattice(blocks, room.blockArea);
}

/// Their places; something is close above those of hidden ones.
void findPlaces(const Scene& scene, const RayScene& rays, RoomTexels& room) {
    constexpr float kGap = 0.25f;  // of a texel's width
    const Unwrap& unwrap = room.unwrap;
    room.hidden.assign(unwrap.atlasSize(), 0);
    room.place.assign(unwrap.atlasSize(), Vec3(0));
    parallelFor(unwrap.texels.size(), 512, [&](std::size_t i) {
        const auto points = unwrap.points.of(i);
        const SurfacePoint& p = points[points.size() / 2];
        const Vec3 place = positionAt(scene, p.triangle, p.barycentric);
        room.place[unwrap.texels[i]] = place;
        const RoomTriangle& triangle = room.triangles[p.triangle];
        const bool front = triangle.charts.front == unwrap.texelChart[i];
        const Vec3 normal = glm::normalize(front ? triangle.areaVector : -triangle.areaVector);
        const float reach = kGap * unwrap.charts[unwrap.texelChart[i]].texelSize();
        room.hidden[unwrap.texels[i]] =
            rays.occluded({place + rays.epsilon() * normal, normal, 0, reach});
    });
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
    room.entryOf.assign(unwrap.atlasSize(), kNoTexel);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const Material& material = scene.material(t);
        room.triangles.push_back({areaVector(scene, t), field.triangleCharts[t], kNoLight,
                                  !material.isSpecular() && !material.isEmitter()});
    }
    for (std::uint32_t l = 0; l < room.sources.lights.size(); ++l)
        for (const std::uint32_t t : room.sources.lights[l].triangles) room.triangles[t].light = l;
    room.excluded.assign(unwrap.atlasSize(), 0);
    for (const auto* texels : {&unwrap.buried, &unwrap.divided})
        for (const ChartTexel& t : *texels) room.excluded[t.texel] = 1;
    parallelFor(unwrap.texels.size(), 512, [&](std::size_t i) {
        const std::uint32_t texel = unwrap.texels[i];
        room.source[texel] = texel;
        room.reflectance[texel] = meanReflectance(scene, unwrap.points.of(i)).diffuse;
        room.area[texel] = unwrap.texelArea(i);
        room.entryOf[texel] = static_cast<std::uint32_t>(i);
    });
    parallelFor(unwrap.charts.size(), 16, [&](std::size_t c) {
        spreadOverChart(unwrap.charts[c], unwrap.atlasWidth, kNoTexel, room.source);
    });
    findPlaces(scene, rays, room);
    groupTexels(scene, room);
    for (const std::uint32_t t : unwrap.texels) {
        room.meanReflectance += room.area[t] * room.reflectance[t];
        room.totalArea += room.area[t];
    }
    if (room.totalArea > 0) room.meanReflectance /= room.totalArea;
    return room;
}

}  // namespace vlf
