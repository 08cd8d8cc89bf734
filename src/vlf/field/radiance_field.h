#pragma once
// The radiance field: view-dependent radiance leaving the charts that are not purely diffuse.
//
// For every oriented direction ω of its direction set and every cell of the ω subfield whose ray
// leaves such a chart: the specular radiance L(ω) (W·m⁻²·sr⁻¹) and the distance d from the surface
// to what is seen in it. Cells are stored by tiles of m x m; only tiles that hold a cell exist.

#include "vlf/base/scratch_memory.h"
#include "vlf/field/chart.h"
#include "vlf/field/parallel_subfield.h"
#include "vlf/math/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// What one cell stores about one chart. Six bytes: radiance in two halves.
struct RadianceElement {
    std::uint16_t rgb9e5Low = 0, rgb9e5High = 0;
    std::uint16_t distance =
        0;  ///< of 65535ths of the longest distance; 0: this cell is not the chart's

    RadianceElement() = default;
    RadianceElement(std::uint32_t rgb9e5, std::uint16_t d)
        : rgb9e5Low(static_cast<std::uint16_t>(rgb9e5)),
          rgb9e5High(static_cast<std::uint16_t>(rgb9e5 >> 16)),
          distance(d) {}

    /// Radiance with shared exponent (EXT_texture_shared_exponent).
    std::uint32_t rgb9e5() const { return rgb9e5Low | std::uint32_t{rgb9e5High} << 16; }
};
static_assert(sizeof(RadianceElement) == 6);

using RadianceElements = std::vector<RadianceElement, ScratchAllocator<RadianceElement>>;

/// A run of tiles within one row of tiles: those that one chart's projection touches there.
struct TileRow {
    std::uint32_t chart = kNoChart;
    std::uint16_t tileX = 0, tileY = 0;  ///< first tile
    std::uint16_t tilesWide = 0;
    std::uint64_t firstElement = 0;  ///< tile by tile, m² elements each, cells row by row
};

struct RadianceField {
    int lines = 0;          ///< of the direction set; 0: the field is empty
    int cells = 0;          ///< N
    int tileSize = 0;       ///< m, a power of two
    float maxDistance = 0;  ///< metres that distance 65535 stands for

    /// Rows of oriented direction i are rows[firstRow[i]] .. rows[firstRow[i + 1]], sorted by chart
    /// and then by tileY; those of one chart have consecutive tileY.
    std::vector<std::uint32_t> firstRow;
    std::vector<TileRow> rows;
    RadianceElements elements;

    bool empty() const { return lines == 0; }
    std::span<const TileRow> rowsOf(std::uint32_t direction) const {
        return {rows.data() + firstRow[direction], rows.data() + firstRow[direction + 1]};
    }
    /// Of elements that live in a file (ScratchAllocator), lets go of the memory of these.
    void release(std::uint64_t first, std::uint64_t count) const {
        elements.get_allocator().release(elements.capacity(), elements.data() + first, count);
    }

    /// The rows of `chart` in `direction`; empty if it has none.
    std::span<const TileRow> rowsOf(std::uint32_t direction, std::uint32_t chart) const;

    std::uint64_t tileElements() const { return static_cast<std::uint64_t>(tileSize) * tileSize; }

    static constexpr std::uint64_t kNoElement = ~0ull;
    /// Index of the element of cell (x, y), or kNoElement where the rows of the chart do not reach.
    std::uint64_t index(std::span<const TileRow> rowsOfChart, int x, int y) const;

    /// That element, or nullptr.
    const RadianceElement* element(std::span<const TileRow> rowsOfChart, int x, int y) const {
        const std::uint64_t i = index(rowsOfChart, x, y);
        return i == kNoElement ? nullptr : &elements[i];
    }
};

/// Shared-exponent packing of non-negative radiance; the error is below 1/512 of the largest
/// channel, or 2⁻²⁵ where that is more. Values above 65408 are clamped.
std::uint32_t packRgb9e5(const Vec3& rgb);
Vec3 unpackRgb9e5(std::uint32_t packed);

}  // namespace vlf
