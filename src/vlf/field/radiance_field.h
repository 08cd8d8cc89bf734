#pragma once
// The radiance field: view-dependent radiance leaving the charts that are not purely diffuse.
//
// For every oriented direction ω of its direction set and every cell of the ω subfield whose ray
// leaves such a chart: the specular radiance L(ω) (W·m⁻²·sr⁻¹) and the distance d from the surface
// to what is seen in it. Cells are stored by tiles of m x m; only tiles that hold a cell exist.

#include "vlf/field/chart.h"
#include "vlf/field/parallel_subfield.h"
#include "vlf/math/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// What one cell stores about one chart.
struct RadianceElement {
    std::uint32_t rgb9e5 = 0;    ///< radiance with shared exponent (EXT_texture_shared_exponent)
    std::uint16_t distance = 0;  ///< of 65535ths of the longest distance; 0: this cell is not the chart's
};

/// The rectangle of tiles that one chart's projection covers in one subfield.
struct TileBlock {
    std::uint32_t chart = kNoChart;
    std::uint16_t tileX = 0, tileY = 0;      ///< first tile
    std::uint16_t tilesWide = 0, tilesHigh = 0;
    std::uint64_t firstElement = 0;  ///< tiles row by row, m² elements each, cells row by row
};

struct RadianceField {
    int lines = 0;            ///< of the direction set; 0: the field is empty
    int cells = 0;            ///< N
    int tileSize = 0;         ///< m
    float maxDistance = 0;    ///< metres that distance 65535 stands for

    /// Blocks of oriented direction i are blocks[firstBlock[i]] .. blocks[firstBlock[i + 1]], one
    /// per chart at most, sorted by chart.
    std::vector<std::uint32_t> firstBlock;
    std::vector<TileBlock> blocks;
    std::vector<RadianceElement> elements;

    bool empty() const { return lines == 0; }
    std::span<const TileBlock> blocksOf(std::uint32_t direction) const {
        return {blocks.data() + firstBlock[direction],
                blocks.data() + firstBlock[direction + 1]};
    }
    /// The block of `chart` in `direction`, or nullptr.
    const TileBlock* find(std::uint32_t direction, std::uint32_t chart) const;

    /// Index of the element of cell (x, y), which lies in one of the block's tiles.
    std::uint64_t index(const TileBlock& block, int x, int y) const;

    /// The element of cell (x, y), or nullptr where the block does not reach.
    const RadianceElement* element(const TileBlock& block, int x, int y) const;
};

/// Shared-exponent packing of non-negative radiance; the error is below 1/512 of the largest
/// channel, or 2⁻²⁵ where that is more. Values above 65408 are clamped.
std::uint32_t packRgb9e5(const Vec3& rgb);
Vec3 unpackRgb9e5(std::uint32_t packed);

}  // namespace vlf
