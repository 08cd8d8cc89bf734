#include "vlf/propagate/piece_tree.h"

#include <algorithm>

namespace vlf {

PieceTree::PieceTree(const std::vector<BlockCost>& blocks, double price, double pieceWork) {
    if (blocks.empty()) return;
    std::vector<const BlockCost*> all;
    for (const BlockCost& b : blocks) all.push_back(&b);
    box_ = boxOf(all);
    int size = 1;
    while (size <= std::max({box_.upper[0], box_.upper[1], box_.upper[2]})) size *= 2;
    cost_ = divide(all, {0, 0, 0}, size, price, pieceWork);
}

PieceTree::Box PieceTree::boxOf(const std::vector<const BlockCost*>& blocks) {
    Box box{blocks[0]->cell, blocks[0]->cell};
    for (const BlockCost* b : blocks)
        for (int a = 0; a < 3; ++a) {
            box.lower[a] = std::min(box.lower[a], b->cell[a]);
            box.upper[a] = std::max(box.upper[a], b->cell[a]);
        }
    return box;
}

PieceCost PieceTree::divide(const std::vector<const BlockCost*>& blocks, const Cell& corner,
                            int size, double price, double pieceWork) {
    if (blocks.empty()) return {};
    const auto priced = [&](const PieceCost& c) { return c.squareError + price * c.work; };
    PieceCost whole;
    int level = kCoarsestLevel;
    for (std::size_t i = 0; i < kLevels; ++i) {
        PieceCost cost{pieceWork, 0};
        for (const BlockCost* b : blocks) {
            cost.work += b->texels[i];
            cost.squareError += b->squareError[i];
        }
        if (i > 0 && priced(cost) >= priced(whole)) continue;
        whole = cost;
        level = kCoarsestLevel + static_cast<int>(i);
    }
    const std::size_t before = pieces_.size();
    PieceCost divided;
    const int half = size / 2;
    for (int octant = 0; octant < 8 && blocks.size() > 1; ++octant) {
        Cell start = corner;
        for (int a = 0; a < 3; ++a)
            if (octant >> a & 1) start[a] += half;
        std::vector<const BlockCost*> within;
        for (const BlockCost* b : blocks) {
            bool inside = true;
            for (int a = 0; a < 3; ++a)
                inside = inside && b->cell[a] >= start[a] && b->cell[a] < start[a] + half;
            if (inside) within.push_back(b);
        }
        const PieceCost part = divide(within, start, half, price, pieceWork);
        divided.work += part.work;
        divided.squareError += part.squareError;
    }
    if (blocks.size() > 1 && priced(divided) < priced(whole)) return divided;
    pieces_.resize(before);
    pieces_.push_back({boxOf(blocks), level});
    return whole;
}

std::size_t PieceTree::pieceAt(const Cell& cell) const {
    std::size_t nearest = kNoPiece;
    int least = 2;
    for (std::size_t i = 0; i < pieces_.size() && least > 0; ++i) {
        int distance = 0;
        for (int a = 0; a < 3; ++a) {
            const Box& box = pieces_[i].box;
            distance += std::max({0, box.lower[a] - cell[a], cell[a] - box.upper[a]});
        }
        if (distance < least) least = distance, nearest = i;
    }
    return nearest;
}

std::vector<std::pair<int, int>> PieceTree::faces() const {
    std::vector<std::pair<int, int>> faces;
    for (const Piece& p : pieces_)
        for (int a = 0; a < 3; ++a) {
            if (p.box.lower[a] > box_.lower[a]) faces.emplace_back(a, p.box.lower[a]);
            if (p.box.upper[a] < box_.upper[a]) faces.emplace_back(a, p.box.upper[a] + 1);
        }
    return faces;
}

}  // namespace vlf
