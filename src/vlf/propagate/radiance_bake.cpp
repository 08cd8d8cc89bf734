#include "vlf/propagate/radiance_bake.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace vlf {

namespace {

constexpr std::size_t kDirectionsLookedAt = 64;
constexpr float kLongestDistance = 8;  // of the scene's radius: mirrors in mirrors

void checkParams(const RadianceParams& p) {
    if (p.cells < 16 || p.cells > 8192)
        throw InputError("cells of the radiance field must lie between 16 and 8192, not " +
                         std::to_string(p.cells));
    if (p.tileSize < 1 || p.tileSize > 256 ||
        !std::has_single_bit(static_cast<unsigned>(p.tileSize)))
        throw InputError("the tile size must be a power of two from 1 to 256, not " +
                         std::to_string(p.tileSize));
}

/// The subfield of a direction, which it shares with its opposite.
ParallelSubfield subfieldOf(const FieldFrame& frame, const DirectionSet& directions,
                            std::uint32_t direction, int cells) {
    const auto line = direction % static_cast<std::uint32_t>(directions.lineCount());
    return makeSubfield(frame, directions.direction(line), cells);
}

std::vector<TileRow> rowsOf(std::uint32_t chart, const TileCover& cover) {
    std::vector<TileRow> rows;
    for (const TileSpan& span : cover.spans) {
        TileRow row;
        row.chart = chart;
        row.tileX = static_cast<std::uint16_t>(span.begin);
        row.tileY = static_cast<std::uint16_t>(cover.firstRow + rows.size());
        row.tilesWide = static_cast<std::uint16_t>(span.end - span.begin);
        rows.push_back(row);
    }
    return rows;
}

/// The rows of one direction, of the given charts.
std::vector<TileRow> rowsOf(std::uint32_t direction, const Scene& scene, const LightField& field,
                            const DirectionSet& directions, const std::vector<MirrorChart>& mirrors,
                            const RadianceParams& params) {
    const ParallelSubfield subfield = subfieldOf(field.frame, directions, direction, params.cells);
    const MirrorCellFinder finder(scene);
    std::vector<TileRow> rows;
    for (const MirrorChart& mirror : mirrors) {
        const auto added = rowsOf(
            mirror.chart,
            finder.tiles(mirror, subfield, directions.direction(direction), params.tileSize));
        rows.insert(rows.end(), added.begin(), added.end());
    }
    return rows;
}

/// The rows of a field of the given charts.
RadianceField makeRows(const Scene& scene, const LightField& field, const DirectionSet& directions,
                       const std::vector<MirrorChart>& mirrors, const RadianceParams& params) {
    RadianceField radiance;
    radiance.lines = params.lines;
    radiance.cells = params.cells;
    radiance.tileSize = params.tileSize;
    radiance.maxDistance = kLongestDistance * field.frame.radius;
    std::vector<std::vector<TileRow>> rows(directions.directionCount());
    parallelFor(rows.size(), 16, [&](std::size_t i) {
        rows[i] = rowsOf(static_cast<std::uint32_t>(i), scene, field, directions, mirrors, params);
    });
    std::uint64_t next = 0;
    radiance.firstRow = {0};
    for (std::vector<TileRow>& ofDirection : rows) {
        for (TileRow& row : ofDirection) {
            row.firstElement = next;
            next += radiance.tileElements() * row.tilesWide;
            radiance.rows.push_back(row);
        }
        radiance.firstRow.push_back(static_cast<std::uint32_t>(radiance.rows.size()));
    }
    return radiance;
}

std::uint64_t elementCount(const RadianceField& radiance) {
    if (radiance.rows.empty()) return 0;
    const TileRow& last = radiance.rows.back();
    return last.firstElement + radiance.tileElements() * last.tilesWide;
}

/// Gives the field its rows, and elements unless it has those of a bake that was left.
void layOut(RadianceField& radiance, const Scene& scene, const LightField& field,
            const DirectionSet& directions, const std::vector<MirrorChart>& mirrors,
            const RadianceParams& params) {
    RadianceElements elements = std::move(radiance.elements);
    radiance = makeRows(scene, field, directions, mirrors, params);
    if (elements.empty())
        elements.resize(elementCount(radiance));
    else if (elements.size() != elementCount(radiance))
        throw InputError("what was baked of the radiance field before is not of this scene");
    radiance.elements = std::move(elements);
}

/// Lets go of the elements of a direction that is done, if they live in a file.
void release(const RadianceField& radiance, std::uint32_t direction) {
    const std::span<const TileRow> rows = radiance.rowsOf(direction);
    if (rows.empty()) return;
    const std::uint64_t first = rows.front().firstElement;
    const std::uint64_t end =
        rows.back().firstElement + radiance.tileElements() * rows.back().tilesWide;
    radiance.release(first, end - first);
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
    const RadianceField radiance = makeRows(scene, field, DirectionSet(params.lines),
                                            mirrorCharts(scene, field, params.kind), params);
    const std::uint64_t elements = elementCount(radiance);
    return {elements, elements * sizeof(RadianceElement) + radiance.rows.size() * sizeof(TileRow) +
                          radiance.firstRow.size() * sizeof(std::uint32_t)};
}

RadianceSize estimateRadianceSize(const Scene& scene, const LightField& field,
                                  const RadianceParams& params) {
    if (params.lines == 0) return {};
    checkParams(params);
    const std::vector<MirrorChart> mirrors = mirrorCharts(scene, field, params.kind);
    if (mirrors.empty()) return {};
    const DirectionSet directions(params.lines);
    const auto count = static_cast<std::size_t>(directions.directionCount());
    const std::size_t looked = std::min(kDirectionsLookedAt, count);
    std::vector<std::uint64_t> tiles(looked), rows(looked);
    parallelFor(looked, 1, [&](std::size_t i) {
        const auto direction = static_cast<std::uint32_t>(i * count / looked);
        for (const TileRow& row : rowsOf(direction, scene, field, directions, mirrors, params)) {
            tiles[i] += row.tilesWide;
            ++rows[i];
        }
    });
    const auto ofAll = [&](const std::vector<std::uint64_t>& some) {
        return std::accumulate(some.begin(), some.end(), std::uint64_t{0}) * count / looked;
    };
    const std::uint64_t elements = ofAll(tiles) * params.tileSize * params.tileSize;
    return {elements, elements * sizeof(RadianceElement) + ofAll(rows) * sizeof(TileRow)};
}

bool fillRadiance(const Scene& scene, const RayScene& rays, const LightField& field,
                  const RadianceParams& params, PartialRadiance& partial, Progress& progress) {
    checkParams(params);
    const std::vector<MirrorChart> mirrors = mirrorCharts(scene, field, params.kind);
    if (mirrors.empty()) return true;
    const DirectionSet directions(params.lines);
    RadianceField& radiance = partial.field;
    if (radiance.empty()) layOut(radiance, scene, field, directions, mirrors, params);
    const EmitterSampler emitters(scene);
    const Sky sky(scene.environment, smoothCap(scene.environment));
    const auto count = static_cast<std::size_t>(directions.directionCount());
    ProgressCounter counter(progress, count, countDone(partial.done));
    return resumeLoop(partial.done, count, 4, counter, [&](std::size_t i) {
        const auto d = static_cast<std::uint32_t>(i);
        const Vec3& toEye = directions.direction(d);
        const ParallelSubfield subfield = subfieldOf(field.frame, directions, d, params.cells);
        MirrorCellFinder finder(scene);
        MirrorViewTracer tracer(scene, rays, field, emitters, sky, params.gloss,
                                radiance.maxDistance,
                                2 * field.frame.radius / static_cast<float>(params.cells));
        RandomStream random(0, d);
        for (const MirrorChart& mirror : mirrors) {
            const auto rows = radiance.rowsOf(d, mirror.chart);
            if (rows.empty()) continue;
            const std::vector<MirrorCell>& cells = finder.find(mirror, subfield, toEye);
            const std::vector<MirrorView>& views =
                tracer.trace(cells, toEye, mirror.planar, random);
            for (std::size_t c = 0; c < cells.size(); ++c) {
                const std::uint64_t e = radiance.index(rows, cells[c].x, cells[c].y);
                if (e == RadianceField::kNoElement) continue;
                radiance.elements[e] = {packRgb9e5(views[c].radiance),
                                        packDistance(views[c].distance, radiance.maxDistance)};
            }
        }
        release(radiance, d);
    });
}

RadianceField bakeRadiance(const Scene& scene, const RayScene& rays, const LightField& field,
                           const RadianceParams& params, Progress& progress) {
    PartialRadiance radiance;
    while (!fillRadiance(scene, rays, field, params, radiance, progress)) {
    }
    return std::move(radiance.field);
}

}  // namespace vlf
