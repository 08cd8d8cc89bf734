#pragma once
// Textures drawn by formula, so that the example scenes need no image files. Each is 8-bit sRGB.

#include "vlf/scene/texture.h"

#include <cstdint>
#include <functional>
#include <string>

namespace vlf {

/// Paints a texture: colour(uv) in sRGB-encoded [0, 1] (clamped), uv at the pixel centres with
/// v = 0 at the bottom.
Texture paintTexture(const std::string& name, int width, int height, Wrap wrap,
                     const std::function<Vec3(const Vec2& uv)>& colour);

/// Sum of octaves of value noise (Perlin, "An image synthesizer", SIGGRAPH 1985), in [0, 1], with
/// period `period` in both coordinates. `period` >= 1.
float fractalNoise(const Vec2& p, int period, int octaves, std::uint64_t seed);

// Repeating surfaces.
Texture woodTexture(const std::string& name, const Vec3& dark, const Vec3& light, int planks);
Texture tileTexture(const std::string& name, const Vec3& tile, const Vec3& other, const Vec3& grout,
                    int tiles);

// Pictures, to be shown once.
Texture mountainPainting();
Texture seaPainting();
Texture blockPainting();
Texture circlePainting();
Texture wavePainting();

// Emission patterns, to be multiplied by a radiance.
Texture skyTexture();     ///< clouds over hills, seen through a window
Texture lavaTexture();    ///< glowing cracks in dark crust
Texture canopyTexture();  ///< a patch of sky between leaves

}  // namespace vlf
