#pragma once
// Antialiased lines and dots of one colour.

#include "vlf/image/image.h"

#include <vector>

namespace vlf {

/// Ink on a transparent sheet the size of a picture: each pixel keeps the strongest ink put there,
/// so that neither the order of strokes nor the joints between them show.
class LineLayer {
  public:
    LineLayer(int width, int height)
        : width_(width), height_(height), ink_(static_cast<std::size_t>(width) * height, 0.0f) {}

    /// A stroke with round ends; positions and thickness in pixels, strength in [0, 1].
    void line(const Vec2& from, const Vec2& to, float thickness, float strength);
    void dot(const Vec2& centre, float diameter, float strength) {
        line(centre, centre, diameter, strength);
    }

    /// Lays the sheet on a picture of the same size.
    void drawOn(Image& image, const Vec3& color) const;

  private:
    int width_, height_;
    std::vector<float> ink_;  ///< coverage times strength, row-major
};

}  // namespace vlf
