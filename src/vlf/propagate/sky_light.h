#pragma once
// The scene's environment as the bake takes it: its smooth part is left to the bundles and to rays
// that leave the scene, its bright part is sampled by direct light.

#include "vlf/field/direction_set.h"
#include "vlf/scene/sky.h"

#include <array>
#include <vector>

namespace vlf {

struct SkyLight {
    Sky sky;
    Sky::Grid smooth;    ///< means over its cells
    Vec3 smoothMean{0};  ///< over the sphere

    /// Of the bright part: directions of equal shares of its luminous flux, that flux (W·m⁻² of a
    /// surface that faces all of it), and a cone about it.
    static constexpr int kShares = 64;
    std::array<Vec3, kShares> shares{};
    float flux = 0;
    Vec3 axis{0, 1, 0};
    float cosine = 1;  ///< of the angle between the axis and the cone's side; -1: all around

    /// Irradiance (luminance) by the bright part of a surface with this unit normal, if nothing
    /// were in the way; about, but 0 where it certainly is.
    float irradiance(const Vec3& normal) const;
};

/// `environment` must outlive it.
SkyLight makeSkyLight(const Environment& environment);

/// What a bundle along each of the turned directions of a set sees outside: the mean of the smooth
/// part over the directions that are nearest to it. Directions of a set stand for uneven solid
/// angles, which the ratio of the sweeps takes for even ones: the difference from the sky's mean is
/// weighted by them. A constant sky stays what it is.
std::vector<Vec3> outsideViews(const SkyLight& light, const DirectionSet& directions,
                               const Mat3& turn);

}  // namespace vlf
