#pragma once
// An environment as light transport sees it: in a smooth part, which any set of directions finds,
// and a bright one, whose directions are to be chosen by its brightness.

#include "vlf/scene/environment.h"

#include <vector>

namespace vlf {

/// Pixel by pixel, the smooth part is what is at most of luminance `cap`, the bright part the rest,
/// in the pixel's colour. Directions of the bright part are drawn in proportion to its luminance
/// (piecewise bilinear, times the sine of the pixel's polar angle).
class Sky {
  public:
    /// Of nothing.
    Sky() = default;

    /// `environment` must outlive it and not change.
    Sky(const Environment& environment, float cap);

    bool isBlack() const { return !environment_ || environment_->isBlack(); }
    bool hasBright() const { return total_ > 0; }

    /// W·m⁻²·sr⁻¹ from a unit direction: all, and the two parts of it.
    Vec3 radiance(const Vec3& direction) const;
    Vec3 smooth(const Vec3& direction) const;
    Vec3 bright(const Vec3& direction) const;

    struct Sample {
        Vec3 direction{0};  ///< unit
        Vec3 bright{0};     ///< radiance of the bright part from there
        float density = 0;  ///< per steradian
    };
    /// Precondition: hasBright().
    Sample sample(const Vec2& u) const;

    /// With which sample() draws a unit direction, per steradian.
    float density(const Vec3& direction) const;

    /// ∫ bright dω: irradiance, W·m⁻², of surfaces that face all of it.
    Vec3 brightFlux() const;

    /// Cosine of the widest angle between `axis` (unit) and a direction of the bright part.
    float brightCosine(const Vec3& axis) const;

    /// Means of the smooth part over the cells of a grid, an equirectangular picture of the same
    /// orientation.
    struct Grid {
        int width = 0, height = 0;
        std::vector<Vec3> radiance;
    };
    Grid smoothGrid(int width, int height) const;

    /// Unit direction of a place of the picture, and of the grid's.
    Vec3 direction(const Vec2& place) const { return skyDirection(*environment_, place); }

  private:
    float brightShare(const Vec3& pixel) const;
    Vec3 smoothAt(const Vec2& place) const;
    Vec3 brightAt(const Vec2& place) const;
    float densityAt(const Vec2& place) const;
    int width() const { return environment_->picture.width; }
    int height() const { return environment_->picture.height; }

    const Environment* environment_ = nullptr;
    float cap_ = 0;
    std::vector<float> weights_;  ///< of pixels
    std::vector<float> columns_;  ///< sum of the weights of a row up to and with a pixel
    std::vector<double> rows_;    ///< sum up to and with a row
    double total_ = 0;
};

/// The cap under which bundles of rays find an environment with little noise: no direction of the
/// smooth part is brighter than four times its mean over the sphere, so that one of a set of
/// thousands carries little of what a surface gets. The greatest such; all of it where none is
/// brighter; 0 where small lamps in the dark are all there is.
float smoothCap(const Environment& environment);

/// Mean luminance over the sphere.
float meanLuminance(const Environment& environment);

}  // namespace vlf
