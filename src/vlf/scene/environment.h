#pragma once
// Light from outside the scene: a sky, the same all around or painted by a picture.

#include "vlf/image/image.h"
#include "vlf/math/vector.h"

#include <string>

namespace vlf {

/// An infinitely far sphere that shines inwards. The picture is equirectangular: its middle lies in
/// direction -Z, the right of that towards +X, the upper edge is +Y.
struct Environment {
    std::string name;  ///< of the picture's file, for people
    Vec3 radiance{0};  ///< W·m⁻²·sr⁻¹; of a picture, what it is multiplied by; black: there is none
    Image picture;     ///< empty: the same all around
    float turn = 0;  ///< degrees that the picture is turned about +Y, counter-clockwise from above

    bool isBlack() const { return !(maxComponent(radiance) > 0); }
    bool isUniform() const { return picture.pixels.empty(); }
};

/// Where a unit direction lies in the picture: u from the left, v from the top, in [0, 1].
Vec2 skyCoordinates(const Environment& environment, const Vec3& direction);

/// The unit direction of a place of the picture.
Vec3 skyDirection(const Environment& environment, const Vec2& place);

/// The four pixels around a place of the picture, and their bilinear weights. It goes on from the
/// right edge to the left one.
struct SkyPixels {
    std::size_t index[4];
    float weight[4];

    SkyPixels(int width, int height, const Vec2& place);
};

/// Radiance that comes from unit `direction`, bilinear between pixels; black if there is none.
Vec3 skyRadiance(const Environment& environment, const Vec3& direction);

/// Reads a picture (.hdr, .exr or any other that readImage reads) as an environment. Negative
/// values become 0. Throws InputError unless it is twice as wide as high and all its values are
/// finite and at most 10⁹, FileError if it cannot be read.
Environment readEnvironment(const std::string& path);

}  // namespace vlf
