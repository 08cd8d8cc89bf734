#include "vlf/render/gl/radiance_layout.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace vlf {

namespace {

constexpr float kShearUnit = 1 / 256.0f, kMostShear = 15;  // exact in a float, times any row
constexpr int kCoarsest = 16;

/// The cells of a row that hold something, first and last.
struct RowExtent {
    int y, first, last;
};

/// In cells of the coarser field.
std::vector<RowExtent> extents(const RadianceField& field, std::span<const TileRow> rows,
                               int coarseness) {
    const int m = field.tileSize;
    std::vector<RowExtent> result;
    for (const TileRow& row : rows)
        for (int y = 0; y < m; ++y) {
            RowExtent extent{(row.tileY * m + y) / coarseness, std::numeric_limits<int>::max(), -1};
            for (int tile = 0; tile < row.tilesWide; ++tile) {
                const RadianceElement* e =
                    &field.elements[row.firstElement +
                                    static_cast<std::uint64_t>(tile) * field.tileElements() +
                                    static_cast<std::uint64_t>(y * m)];
                const int firstX = (row.tileX + tile) * m;
                for (int x = 0; x < m; ++x) {
                    if (e[x].distance == 0) continue;
                    extent.first = std::min(extent.first, (firstX + x) / coarseness);
                    extent.last = (firstX + x) / coarseness;
                }
            }
            if (extent.last < 0) continue;
            if (result.empty() || result.back().y != extent.y)
                result.push_back(extent);
            else
                result.back() = {extent.y, std::min(result.back().first, extent.first),
                                 std::max(result.back().last, extent.last)};
        }
    return result;
}

int shift(float shear, int row) {
    return static_cast<int>(std::floor(shear * static_cast<float>(row)));
}

/// First and last column of the rectangle with a shear.
std::pair<int, int> columns(const std::vector<RowExtent>& rows, float shear) {
    int first = std::numeric_limits<int>::max(), last = std::numeric_limits<int>::min();
    for (const RowExtent& row : rows) {
        const int offset = shift(shear, row.y - rows.front().y);
        first = std::min(first, row.first - offset);
        last = std::max(last, row.last - offset);
    }
    return {first, last};
}

/// The shear of the narrowest rectangle: its width is convex in the shear but for rounding.
float bestShear(const std::vector<RowExtent>& rows) {
    const auto width = [&](int s) {
        const auto [first, last] = columns(rows, static_cast<float>(s) * kShearUnit);
        return last - first;
    };
    int lower = static_cast<int>(-kMostShear / kShearUnit), upper = -lower;
    while (upper - lower > 8) {
        const int a = lower + (upper - lower) / 3, b = upper - (upper - lower) / 3;
        (width(a) < width(b) ? upper : lower) = width(a) < width(b) ? b : a;
    }
    int best = 0;
    for (int s = lower; s <= upper; ++s)
        if (width(s) < width(best)) best = s;
    return static_cast<float>(best) * kShearUnit;
}

RadianceRecord recordOf(const std::vector<RowExtent>& rows) {
    if (rows.empty()) return {};
    RadianceRecord record;
    record.shear = bestShear(rows);
    const auto [first, last] = columns(rows, record.shear);
    record.x = static_cast<std::uint16_t>(first + 0x8000);
    record.y = static_cast<std::uint16_t>(rows.front().y);
    record.width = static_cast<std::uint16_t>(last - first + 1);
    record.height = static_cast<std::uint16_t>(rows.back().y - rows.front().y + 1);
    return record;
}

}  // namespace

int RadianceRecord::firstColumn(int row) const {
    return x - 0x8000 + shift(shear, row);
}

RadianceLayout layOutRadiance(const RadianceField& field, const std::vector<std::uint32_t>& charts,
                              int coarseness) {
    RadianceLayout layout;
    layout.coarseness = coarseness;
    if (field.empty()) return layout;
    const auto directions = static_cast<std::size_t>(2 * field.lines);
    layout.records.resize(charts.size() * directions);
    parallelFor(layout.records.size(), 16, [&](std::size_t i) {
        const auto direction = static_cast<std::uint32_t>(i % directions);
        const auto rows = field.rowsOf(direction, charts[i / directions]);
        layout.records[i] = recordOf(extents(field, rows, coarseness));
    });
    for (RadianceRecord& record : layout.records) {
        record.firstElement = static_cast<std::uint32_t>(layout.elements);
        layout.elements += std::uint64_t{record.width} * record.height;
    }
    return layout;
}

RadianceLayout layOutWithin(const RadianceLimits& limits, const RadianceField& field,
                            const std::vector<std::uint32_t>& charts) {
    for (int coarseness = 1;; coarseness *= 2) {
        RadianceLayout layout = layOutRadiance(field, charts, coarseness);
        if (layout.elements <= limits.elements && layout.bytes() <= limits.bytes) return layout;
        if (2 * coarseness > std::min(kCoarsest, field.tileSize))
            throw InputError("the radiance of mirrors, even with cells of " +
                             std::to_string(coarseness) + " x " + std::to_string(coarseness) +
                             " made one, takes " + std::to_string(layout.bytes()) + " bytes in " +
                             std::to_string(layout.elements) +
                             " elements, more than there is room for on the GPU (" +
                             std::to_string(std::min(limits.bytes, 4 * limits.elements)) +
                             " bytes): bake with fewer --radiance-cells or "
                             "--radiance-directions, or render with --backend cpu");
    }
}

}  // namespace vlf
