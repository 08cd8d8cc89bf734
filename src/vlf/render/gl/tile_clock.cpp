#include "vlf/render/gl/tile_clock.h"

#include <algorithm>

namespace vlf::gl {

namespace {

constexpr double kFirstGuess = 2e-6;  // seconds a pixel

}  // namespace

void TileClock::resize(int width, int height) {
    columns_ = (width + kCell - 1) / kCell;
    const int rows = (height + kCell - 1) / kCell;
    perPixel_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows),
                     kFirstGuess);
}

/// Calls visit(cell, pixels of it in the tile).
template <class Visit>
void TileClock::visitCells(const PixelRectangle& tile, const Visit& visit) const {
    const int right = tile.x + tile.width, top = tile.y + tile.height;
    for (int row = tile.y / kCell; row * kCell < top; ++row)
        for (int column = tile.x / kCell; column * kCell < right; ++column) {
            const int width =
                std::min(right, (column + 1) * kCell) - std::max(tile.x, column * kCell);
            const int height = std::min(top, (row + 1) * kCell) - std::max(tile.y, row * kCell);
            visit(static_cast<std::size_t>(row * columns_ + column),
                  static_cast<double>(width) * height);
        }
}

double TileClock::shading(const PixelRectangle& tile) const {
    double seconds = 0;
    visitCells(tile, [&](std::size_t cell, double pixels) { seconds += pixels * perPixel_[cell]; });
    return seconds;
}

void TileClock::note(const PixelRectangle& tile, double seconds) {
    least_ = std::min(least_, seconds);
    const double pixels = static_cast<double>(tile.width) * tile.height;
    const double rate = (seconds - least_) / pixels;
    // The machine may have had other work to do: half believed if it is more than expected.
    visitCells(tile, [&](std::size_t cell, double) {
        double& known = perPixel_[cell];
        known = rate > known ? 0.5 * (known + rate) : rate;
    });
}

}  // namespace vlf::gl
