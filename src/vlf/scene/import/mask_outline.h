#pragma once
// The outline of the solid part of a masked triangle.

#include "vlf/math/vector.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace vlf {

/// A corner of an outline. The triangle's corners A, B, C have the weights (0, 0), (1, 0) and
/// (0, 1).
struct OutlinePoint {
    glm::dvec2 weights{0};  ///< of B and C
    glm::dvec2 place{0};  ///< in the triangle's plane; the longest edge is as long as it has steps
    unsigned sides = 0;   ///< on which edges it lies: 1: AB, 2: BC, 4: CA
};

/// A closed line with the solid part on its left: counter-clockwise around it, clockwise around a
/// hole.
using Outline = std::vector<OutlinePoint>;

double signedArea(const Outline& outline);

/// Opacity minus threshold at weights of B and C: solid where it is not negative.
using Excess = std::function<float(const glm::dvec2& weights)>;

enum class MaskCover { solid, none, mixed };

/// What is solid of a triangle.
struct MaskedPart {
    MaskCover cover = MaskCover::solid;
    std::vector<Outline> outlines;  ///< of a mixed one
};

/// Finds the solid part with `steps` samples along every edge, between which the excess counts as
/// linear. `shape`: places of A, B and C, counter-clockwise. Parts of less than a quarter of a
/// square step are left out. Nothing if the outlines have more than kMostOutlinePoints points.
std::optional<MaskedPart> solidPart(const Excess& excess, int steps,
                                    const std::array<glm::dvec2, 3>& shape);

inline constexpr std::size_t kMostOutlinePoints = 100'000;

/// The outline without the points that lie nearer than `tolerance` to the line through the others
/// (D. H. Douglas and T. K. Peucker, 1973); those at edges of the triangle stay, so that
/// neighbours fit together.
Outline simplified(const Outline& outline, double tolerance);

}  // namespace vlf
