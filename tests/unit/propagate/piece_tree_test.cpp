#include "vlf/propagate/piece_tree.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vlf::test {

namespace {

/// 8 x 8 blocks of 100 even texels; what `bent` tells of has a square error of 1 with even texels,
/// which falls with their size.
template <class Bent>
std::vector<BlockCost> blocks(Bent bent) {
    std::vector<BlockCost> all;
    for (int x = 0; x < 8; ++x)
        for (int z = 0; z < 8; ++z) {
            BlockCost b;
            b.cell = {x, 0, z};
            for (std::size_t i = 0; i < kLevels; ++i) {
                const double scale = std::exp2(-(kCoarsestLevel + static_cast<int>(i)));
                b.texels[i] = 100 / (scale * scale);
                b.squareError[i] = bent(x, z) ? scale : 0;
            }
            all.push_back(b);
        }
    return all;
}

}  // namespace

TEST(PieceTree, OfEvenLightIsOnePieceOfTheLargestTexels) {
    const PieceTree tree(blocks([](int, int) { return false; }), 1e-3, 10);
    ASSERT_EQ(tree.pieces(), 1u);
    EXPECT_EQ(tree.level(0), kCoarsestLevel);
    EXPECT_TRUE(tree.faces().empty());
    EXPECT_DOUBLE_EQ(tree.cost().work, 64 * 25 + 10);
}

TEST(PieceTree, GivesTheBlockWhereLightBendsFinerTexels) {
    const PieceTree tree(blocks([](int x, int z) { return x == 2 && z == 5; }), 1e-4, 10);
    EXPECT_EQ(tree.level(tree.pieceAt({2, 0, 5})), kFinestLevel);
    EXPECT_EQ(tree.level(tree.pieceAt({6, 0, 6})), kCoarsestLevel);
    EXPECT_EQ(tree.level(tree.pieceAt({2, 0, 4})), kCoarsestLevel);
    EXPECT_EQ(tree.pieces(), 10u);  // three for each halving
}

TEST(PieceTree, IsNotDividedWherePiecesCostMoreThanTheyGain) {
    const auto bent = blocks([](int x, int z) { return x == 2 && z == 5; });
    EXPECT_EQ(PieceTree(bent, 1e-4, 1e6).pieces(), 1u);
    EXPECT_LT(PieceTree(bent, 1e-4, 1000).pieces(), PieceTree(bent, 1e-4, 10).pieces());
}

TEST(PieceTree, HoldsWhatIsBesideItsBlocksAndNothingFarther) {
    std::vector<BlockCost> one = blocks([](int, int) { return true; });
    one.resize(1);
    const PieceTree tree(one, 1e-4, 10);
    EXPECT_EQ(tree.pieceAt({0, 0, 0}), 0u);
    EXPECT_EQ(tree.pieceAt({1, 0, 0}), 0u);
    EXPECT_EQ(tree.pieceAt({1, 0, 1}), PieceTree::kNoPiece);
}

}  // namespace vlf::test
