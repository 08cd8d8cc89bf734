#pragma once
// Radiance elements as bytes: reduced in precision, predicted from their neighbours and split
// into byte planes. Elements that are not their chart's cost one bit before compression.

#include "vlf/field/radiance_field.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// Largest m; a tile then fills half a block.
inline constexpr int kMaxTileSize = 256;

/// The tiles of all rows of a field in order, cut into groups that are coded independently.
class TileGroups {
  public:
    /// Precondition: the layout is valid (checkRadianceLayout). Keeps a reference to `field`.
    explicit TileGroups(const RadianceField& field);

    std::uint64_t tileCount() const { return firstTile_.back(); }
    std::uint64_t elementCount() const { return tileCount() * tileElements_; }
    std::uint64_t count() const { return (tileCount() + groupTiles_ - 1) / groupTiles_; }

    /// Elements of group g.
    std::uint64_t groupElements(std::uint64_t g) const;

    /// The group's elements as bytes. Each channel is rounded to 8 significant bits (relative
    /// error <= 1/256 of the channel, 0.16 % RMS of the brightest), the distance to 1/4096 of the
    /// longest.
    std::vector<std::uint8_t> encode(std::uint64_t g) const;

    /// The inverse, into the elements of a field whose rows lie one after the other in `all`.
    /// Returns false if the bytes cannot be a group's.
    bool decode(std::uint64_t g, std::span<const std::uint8_t> bytes,
                std::span<RadianceElement> all) const;

  private:
    struct Tile;
    template <class Visit>
    void visitPredicted(std::uint64_t g, const Visit& visit) const;
    /// From the start of row r back to the tile of the row above at tileX; 0: it has none.
    std::uint64_t stepsUp(std::size_t r, int tileX) const;
    Tile tileAt(std::uint64_t index) const;
    std::vector<RadianceElement> gather(std::uint64_t g) const;

    const RadianceField& field_;
    std::uint64_t tileElements_, groupTiles_;
    std::vector<std::uint64_t> firstTile_;  ///< of each row, and the number of all
};

}  // namespace vlf
