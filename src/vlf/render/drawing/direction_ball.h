#pragma once
// A ball that shows a direction set: a cell per direction, the triangulation, and dots.

#include "vlf/field/direction_set.h"
#include "vlf/render/drawing/pen.h"
#include "vlf/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf {

namespace ball {
inline constexpr float kDotRadius = 0.11f;   ///< of the root of the mean solid angle
inline constexpr float kRimWeight = 0.025f;  ///< of a corner, below which the opposite edge shows
inline constexpr float kRimShade = 0.3f;     ///< of the cell's colour there
inline constexpr Vec3 kUpperDot = kInk, kLowerDot{0.35f};
/// Brightness at the outline, and how much more it is where the ball faces the eye.
inline constexpr float kOutlineShade = 0.4f, kFacingShade = 0.6f;
}  // namespace ball

/// A ball straight before the camera, in the middle of the picture and three quarters of its
/// smaller side wide; it looks the same at every distance of its centre (metres).
Sphere ballBefore(const Camera& camera, int width, int height, float distance);

/// White at the mean solid angle, blue below and red above, full at a tenth off the mean.
Vec3 weightColor(float relativeToMean);

/// Of the ball towards unit vector d, before shading.
Vec3 directionColor(const DirectionSet& set, const Vec3& d);

/// A vertex of the ball as triangles.
struct BallVertex {
    Vec3 position{0};  ///< unit
    Vec2 weight{0};    ///< in DirectionSet::triple there, of the first two of `corner`
    std::array<std::uint32_t, 3> corner{};  ///< oriented directions, the same for all of a triangle
};

/// Counter-clockwise triangles from outside, three vertices each: those of the direction set, cut
/// into smaller ones where they are large.
std::vector<BallVertex> makeBall(const DirectionSet& set);

}  // namespace vlf
