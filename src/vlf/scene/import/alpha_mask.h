#pragma once
// Which parts of masked surfaces are solid.

#include "vlf/image/image_io.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace vlf {

/// What of an image is its alpha: the channel of that name or, where the image has none, the
/// luminance; or one channel.
enum class AlphaSource { alphaOrLuminance, alpha, luminance, red, green, blue };

/// Opacity over a texture, in several resolutions, each half the one before.
class AlphaImage {
  public:
    AlphaImage(const DecodedImage& image, AlphaSource source, Wrap wrapU, Wrap wrapV);

    int width() const { return levels_[0].width; }
    int height() const { return levels_[0].height; }
    int levelCount() const { return static_cast<int>(levels_.size()); }

    /// Bilinearly interpolated opacity, [0, 1], at texture coordinates (v up; any finite value).
    float sample(const Vec2& uv, int level) const;

  private:
    struct Level {
        int width = 0, height = 0;
        std::vector<std::uint8_t> alpha;
    };
    static Level halved(const Level& level);

    std::vector<Level> levels_;
    Wrap wrapU_, wrapV_;
};

/// A surface is solid where the image is at least `threshold`.
struct AlphaMask {
    int image = 0;  ///< index into MaskedMaterials::images
    float threshold = 0.5f;
};

/// The masks of an imported scene, by material.
struct MaskedMaterials {
    std::vector<AlphaImage> images;
    std::unordered_map<std::uint32_t, AlphaMask> masks;
    /// Texture coordinates of masks by vertex, as far as they differ from those of the scene.
    std::unordered_map<std::uint32_t, Vec2> uvs;
};

/// A scene file as read.
struct ImportedScene {
    Scene scene;
    MaskedMaterials masked;
    /// Materials of glass that is solid or a pane as its shape says (glass_bodies.h).
    std::vector<std::uint32_t> glass;
};

}  // namespace vlf
