#pragma once
// A made-up baked room with the statistics of a real one: smooth irradiance with the noise of a
// bake, and a mirror that shows walls, edges and a ball.

#include "vlf/io/field_file.h"

namespace vlf::test {

struct ExampleSize {
    int texelsPerMetre = 8;
    int lines = 9;  ///< of the radiance field; 0: none
    int cells = 24;
    int tileSize = 8;
    int textureSide = 16;
};

/// A closed box of 4 m x 3 m x 5 m, the wall at the lowest z being a mirror.
BakedRoom makeExampleRoom(const ExampleSize& size = {});

/// Largest difference of a channel relative to the channel in `expected`.
double largestRelativeError(const Vec3& actual, const Vec3& expected);

}  // namespace vlf::test
