#pragma once
// How long parts of a picture take to draw, learnt from those that were.

#include <algorithm>

namespace vlf::gl {

/// Seconds of a part: what every part takes, whatever its size, and at most so much a pixel.
class TileClock {
  public:
    double drawing(double pixels) const { return least_ + shading(pixels); }
    double shading(double pixels) const { return perPixel_ * pixels; }

    void note(double pixels, double seconds) {
        least_ = noted_ ? std::min(least_, seconds) : seconds;
        noted_ = true;
        perPixel_ = std::max(kDecay * perPixel_, (seconds - least_) / pixels);
    }

  private:
    /// A dear part of the picture is remembered until the next pass over it.
    static constexpr double kDecay = 0.995;

    double least_ = 0, perPixel_ = 2e-6;
    bool noted_ = false;
};

}  // namespace vlf::gl
