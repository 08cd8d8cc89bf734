#pragma once
// Paper, ink and pens of drawings, which the CPU and OpenGL draw alike.

#include "vlf/math/vector.h"

#include <cstdint>

namespace vlf {

/// Display-linear.
inline constexpr Vec3 kPaper{0.92f, 0.93f, 0.95f};
inline constexpr Vec3 kInk{0.02f, 0.03f, 0.06f};

/// How lines of one kind are drawn. A sheet is transparent, has ink of one colour, and keeps of
/// each pixel the strongest ink put there; the sheets of a drawing lie on one another in order.
struct Pen {
    float thickness;  ///< pixels
    float strength;   ///< in [0, 1]
    int sheet;
};

/// A line through space; a dot where both ends are one point.
struct PenLine {
    Vec3 from{0}, to{0};
    std::uint32_t pen = 0;  ///< index into the drawing's pens
};

}  // namespace vlf
