#pragma once
// Images mapped onto surfaces.

#include "vlf/math/vector.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vlf {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// An RGB(A) image, either 8-bit sRGB-encoded or linear float; exactly one of the two pixel
/// vectors is filled. Row 0 is the top row; v = 0 is the bottom of the image (OBJ convention; the
/// glTF importer flips v).
struct Texture {
    std::string name;
    int width = 0, height = 0;
    std::vector<std::uint8_t> srgb8;  ///< RGBA, 4 bytes a pixel; RGB sRGB-encoded, A linear
    std::vector<Vec3> linear;         ///< for high dynamic range images
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;

    /// Linear RGB of pixel (x, y), 0 <= x < width, 0 <= y < height.
    Vec3 pixel(int x, int y) const;

    /// Bilinearly interpolated linear RGB at texture coordinates (any finite value).
    Vec3 sample(const Vec2& uv) const;

    /// Mean linear RGB over the whole image.
    Vec3 average() const;
};

}  // namespace vlf
