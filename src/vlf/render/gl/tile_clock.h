#pragma once
// How long parts of a picture take to draw, learnt from when they were drawn before.

#include "vlf/render/gl/view.h"

#include <cstddef>
#include <vector>

namespace vlf::gl {

/// Keeps what a pixel takes, cell by cell of the picture, and what every tile takes besides.
class TileClock {
  public:
    static constexpr int kCell = 64;  ///< pixels along a side

    /// Of pictures of another size; knows nothing of them.
    void resize(int width, int height);

    /// Seconds that drawing a tile will take, and the part of them that a smaller one saves.
    double drawing(const PixelRectangle& tile) const { return least_ + shading(tile); }
    double shading(const PixelRectangle& tile) const;

    void note(const PixelRectangle& tile, double seconds);

  private:
    template <class Visit>
    void visitCells(const PixelRectangle& tile, const Visit& visit) const;

    int columns_ = 0;
    std::vector<double> perPixel_;  ///< seconds, of each cell
    double least_ = 1;              ///< seconds of the cheapest tile so far
};

}  // namespace vlf::gl
