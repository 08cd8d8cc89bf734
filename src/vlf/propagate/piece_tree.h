#pragma once
// The blocks of a surface merged into cubes of one level each, by an octree.

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace vlf {

/// Sizes of texels are 2^-level times the even one's.
inline constexpr int kCoarsestLevel = -1, kFinestLevel = 2;
inline constexpr std::size_t kLevels = kFinestLevel - kCoarsestLevel + 1;

using Cell = std::array<int, 3>;  ///< of a grid of cubes, not negative

/// A block, and what it costs to give it texels of each level.
struct BlockCost {
    Cell cell{};
    std::array<double, kLevels> texels{}, squareError{};
};

/// What is lost of one surface's pieces, all together.
struct PieceCost {
    double work = 0;  ///< texels, pieces included
    double squareError = 0;
};

class PieceTree {
  public:
    PieceTree() = default;

    /// The pieces that cost least: square error and `price` times work, a piece being worth
    /// `pieceWork` texels (pruning as by L. Breiman et al. 1984).
    PieceTree(const std::vector<BlockCost>& blocks, double price, double pieceWork);

    std::size_t pieces() const { return pieces_.size(); }
    int level(std::size_t piece) const { return pieces_[piece].level; }
    const PieceCost& cost() const { return cost_; }

    /// The piece that holds a cell or is next to it; kNoPiece if there is none.
    std::size_t pieceAt(const Cell& cell) const;
    static constexpr std::size_t kNoPiece = ~std::size_t{0};

    /// Axes and cells at whose lower faces pieces adjoin. May repeat itself.
    std::vector<std::pair<int, int>> faces() const;

  private:
    struct Box {
        Cell lower, upper;  // both within
    };
    struct Piece {
        Box box;
        int level;
    };

    static Box boxOf(const std::vector<const BlockCost*>& blocks);
    PieceCost divide(const std::vector<const BlockCost*>& blocks, const Cell& corner, int size,
                     double price, double pieceWork);

    std::vector<Piece> pieces_;
    PieceCost cost_;
    Box box_{};  // of all blocks
};

}  // namespace vlf
