#include "vlf/propagate/radiance_bake.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/propagate/mirror_view.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace vlf {

namespace {

constexpr float kLongestDistance = 8;  // of the scene's radius: mirrors in mirrors

void checkParams(const RadianceParams& p) {
    if (p.cells < 16 || p.cells > 8192)
        throw InputError("cells of the radiance field must lie between 16 and 8192, not " +
                         std::to_string(p.cells));
    if (p.tileSize < 1 || p.tileSize > 256)
        throw InputError("the tile size must lie between 1 and 256, not " +
                         std::to_string(p.tileSize));
}

/// The subfield of a direction, which it shares with its opposite.
ParallelSubfield subfieldOf(const FieldFrame& frame, const DirectionSet& directions,
                            std::uint32_t direction, int cells) {
    const auto line = direction % static_cast<std::uint32_t>(directions.lineCount());
    return makeSubfield(frame, directions.direction(line), cells);
}

TileBlock blockOf(std::uint32_t chart, const CellRange& range, int tileSize) {
    TileBlock block;
    block.chart = chart;
    block.tileX = static_cast<std::uint16_t>(range.x0 / tileSize);
    block.tileY = static_cast<std::uint16_t>(range.y0 / tileSize);
    block.tilesWide = static_cast<std::uint16_t>((range.x1 - 1) / tileSize + 1 - block.tileX);
    block.tilesHigh = static_cast<std::uint16_t>((range.y1 - 1) / tileSize + 1 - block.tileY);
    return block;
}

/// A field of the given charts with its blocks but without elements.
RadianceField layOut(const Scene& scene, const LightField& field, const DirectionSet& directions,
                     const std::vector<MirrorChart>& mirrors, const RadianceParams& params) {
    RadianceField radiance;
    radiance.lines = params.lines;
    radiance.cells = params.cells;
    radiance.tileSize = params.tileSize;
    radiance.maxDistance = kLongestDistance * field.frame.radius;
    std::vector<std::vector<TileBlock>> blocks(directions.directionCount());
    parallelFor(blocks.size(), 16, [&](std::size_t i) {
        const auto d = static_cast<std::uint32_t>(i);
        const ParallelSubfield subfield = subfieldOf(field.frame, directions, d, params.cells);
        const MirrorCellFinder finder(scene);
        for (const MirrorChart& mirror : mirrors) {
            const CellRange range = finder.range(mirror, subfield, directions.direction(d));
            if (!range.empty()) blocks[i].push_back(blockOf(mirror.chart, range, params.tileSize));
        }
    });
    std::uint64_t next = 0;
    radiance.firstBlock = {0};
    for (std::vector<TileBlock>& ofDirection : blocks) {
        for (TileBlock& block : ofDirection) {
            block.firstElement = next;
            next += static_cast<std::uint64_t>(block.tilesWide) * block.tilesHigh *
                    params.tileSize * params.tileSize;
            radiance.blocks.push_back(block);
        }
        radiance.firstBlock.push_back(static_cast<std::uint32_t>(radiance.blocks.size()));
    }
    return radiance;
}

std::uint64_t elementCount(const RadianceField& radiance) {
    if (radiance.blocks.empty()) return 0;
    const TileBlock& last = radiance.blocks.back();
    return last.firstElement + static_cast<std::uint64_t>(last.tilesWide) * last.tilesHigh *
                                   radiance.tileSize * radiance.tileSize;
}

std::uint16_t packDistance(float distance, float longest) {
    if (distance <= 0) return 0;
    return static_cast<std::uint16_t>(
        std::clamp(std::round(distance / longest * 65535), 1.0f, 65535.0f));
}

}  // namespace

RadianceSize radianceSize(const Scene& scene, const LightField& field,
                          const RadianceParams& params) {
    checkParams(params);
    const RadianceField radiance =
        layOut(scene, field, DirectionSet(params.lines), mirrorCharts(scene, field), params);
    const std::uint64_t elements = elementCount(radiance);
    return {elements, elements * sizeof(RadianceElement) +
                          radiance.blocks.size() * sizeof(TileBlock) +
                          radiance.firstBlock.size() * sizeof(std::uint32_t)};
}

RadianceField bakeRadiance(const Scene& scene, const RayScene& rays, const LightField& field,
                           const RadianceParams& params, Progress& progress) {
    checkParams(params);
    const std::vector<MirrorChart> mirrors = mirrorCharts(scene, field);
    if (mirrors.empty()) return {};
    const DirectionSet directions(params.lines);
    RadianceField radiance = layOut(scene, field, directions, mirrors, params);
    radiance.elements.resize(elementCount(radiance));
    const auto mirrorOf = [&](std::uint32_t chart) -> const MirrorChart& {
        return *std::lower_bound(mirrors.begin(), mirrors.end(), chart,
                                 [](const MirrorChart& m, std::uint32_t c) { return m.chart < c; });
    };
    const auto count = static_cast<std::size_t>(directions.directionCount());
    ProgressCounter done(progress, count);
    parallelFor(count, 4, [&](std::size_t i) {
        const auto d = static_cast<std::uint32_t>(i);
        const Vec3& toEye = directions.direction(d);
        const ParallelSubfield subfield = subfieldOf(field.frame, directions, d, params.cells);
        MirrorCellFinder finder(scene);
        MirrorViewTracer tracer(scene, rays, field, radiance.maxDistance);
        for (const TileBlock& block : radiance.blocksOf(d)) {
            const MirrorChart& mirror = mirrorOf(block.chart);
            const std::vector<MirrorCell>& cells = finder.find(mirror, subfield, toEye);
            const std::vector<MirrorView>& views = tracer.trace(cells, toEye, mirror.planar);
            for (std::size_t c = 0; c < cells.size(); ++c)
                radiance.elements[radiance.index(block, cells[c].x, cells[c].y)] = {
                    packRgb9e5(views[c].radiance),
                    packDistance(views[c].distance, radiance.maxDistance)};
        }
        done.step();
    });
    return radiance;
}

}  // namespace vlf
