#pragma once
// The lines of a direction set that cross an object, on a grid of its own in each direction.

#include "vlf/dynamic/object_receivers.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Where a line enters or leaves the object, in the model's space.
struct LineEnd {
    Vec3 point{0};
    std::uint32_t receiver = ObjectReceivers::kNone;  ///< that is seen from outside there
    std::uint32_t triangle = 0;
    Vec2 barycentric{0};
};

/// Entries and exits by line of the direction set: those of line k are firstCell[k] to
/// firstCell[k + 1]. A line stands for cellArea (m², model space) times its solid angle, both ways.
struct ObjectLines {
    std::vector<Vec3> directions;  ///< of the lines, unit
    std::vector<float> weights;    ///< sr
    std::vector<std::uint32_t> firstCell;
    std::vector<LineEnd> entries, exits;
    float cellArea = 0;
};

/// `cell`: width of a grid's cell, metres in the model's space. Grids are shifted at random in each
/// direction.
ObjectLines makeObjectLines(const ObjectReceivers& receivers, const Sphere& bounds, int lines,
                            float cell);

}  // namespace vlf
