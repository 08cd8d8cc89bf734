#pragma once
// Pictures to and from files. Read are OpenEXR and Radiance HDR (linear), PNG, JPEG, TGA and BMP
// (encoded in sRGB), as textures WebP too; written OpenEXR and PNG.
// Every reader takes at most kMaxPixels pixels; larger, damaged or unknown files throw InputError,
// files that cannot be opened FileError. Writers write beside the target and rename, so that a
// failure (FileError) leaves what was there before.

#include "vlf/image/image.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace vlf {

inline constexpr std::size_t kMaxPixels = std::size_t{1} << 28;

/// What a texture file holds; exactly one of the two pixel vectors is filled. Row 0 at the top.
struct DecodedImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> srgb8;  ///< RGBA, 4 bytes a pixel; RGB sRGB-encoded, A linear
    std::vector<Vec3> linear;         ///< linear RGB, of high dynamic range files (EXR, HDR)
    bool hasAlpha = false;            ///< the file has an alpha channel; else A is 255
};

/// Decodes a whole image file held in memory (format found by content). `nameForErrors` is put in
/// front of the message of an InputError.
DecodedImage decodeImage(std::span<const std::uint8_t> bytes, const std::string& nameForErrors);

/// decodeImage of a file on disk.
DecodedImage readTextureImage(const std::string& path);

/// Reads a picture as linear RGB: EXR and HDR as they are, integer formats decoded from sRGB. Of
/// an EXR the data window is read, from channels R, G, B (a missing one is 0) or grey from Y.
Image readImage(const std::string& path);

/// Names and values of string attributes in an EXR header.
using ImageAttributes = std::map<std::string, std::string>;

/// Writes 32-bit float channels R, G, B, ZIP-compressed; reading gives back the same bits.
void writeExr(const std::string& path, const Image& image, const ImageAttributes& attributes = {});

/// Writes 8-bit RGB. The image is linear in [0, 1] (tone-mapped, see tone_map.h); values are
/// clamped and encoded to sRGB. NaN becomes 0.
void writePng(const std::string& path, const Image& image);

}  // namespace vlf
