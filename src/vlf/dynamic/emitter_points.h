#pragma once
// Points that stand for a room's emitters when light at a place is sought in a few samples: always
// the same ones, so that light does not flicker while things move.

#include "vlf/dynamic/room_texels.h"
#include "vlf/scene/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// A point of an emitter or of its image in mirrors, and the piece of it that it stands for.
struct EmitterPoint {
    Vec3 position{0};  ///< where it is seen
    Vec3 normal{0};    ///< unit, on the emitting side, as seen
    Vec3 emitter{0};   ///< where it is
    Vec3 radiance{0};  ///< W·m⁻²·sr⁻¹
    float area = 0;    ///< m²
};

/// The points of one emitter or image, in a row.
struct EmitterShare {
    std::uint32_t image = 0;  ///< of LightSources::images
    std::uint32_t first = 0, count = 0;
    bool exact = false;  ///< `triangles` are all of it, and its radiance is the same all over
    std::vector<std::array<Vec3, 3>> triangles;
};

struct EmitterPoints {
    std::vector<EmitterPoint> points;
    std::vector<EmitterShare> shares;
    bool withImages = false;  ///< those of LightSources are among them
};

/// About `count` points, spread over each emitting surface in proportion to emitted power: the same
/// number on each, and one at least. Images have a quarter as many; where there are more than 64,
/// none. Another `pattern` gives other points.
EmitterPoints spreadPoints(const Scene& scene, const LightSources& sources, int count, int pattern);

/// Solid angle (steradian) of triangle abc as seen from p (Van Oosterom and Strackee 1983).
float triangleSolidAngle(const Vec3& p, const std::array<Vec3, 3>& triangle);

/// Solid angle that each point of `share` stands for as seen from p; of points that face away, 0.
/// Where the emitter allows, their sum is exact; it is no more than 2π. `solidAngles` has
/// share.count entries.
void solidAngles(const EmitterPoints& emitters, const EmitterShare& share, const Vec3& p,
                 std::span<float> solidAngles);

}  // namespace vlf
