#pragma once
// Pieces of surfaces that have texels of a size of their own.

#include <cstdint>
#include <vector>

namespace vlf {

/// Of one triangle. Triangles of different pieces share no chart.
struct TexelPiece {
    std::uint32_t piece = 0;
    float scale = 1;  ///< of the texels' size
};

/// By triangle of a scene; empty: all are one piece.
using TexelPieces = std::vector<TexelPiece>;

}  // namespace vlf
