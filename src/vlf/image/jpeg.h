#pragma once
// JPEG files in memory, decoded by libjpeg-turbo.

#include "vlf/image/image_io.h"

#include <cstdint>
#include <span>
#include <string>

namespace vlf {

/// True for bytes that begin like a JPEG file.
bool isJpeg(std::span<const std::uint8_t> bytes);

/// The picture as sRGB-encoded bytes, of grey, YCbCr, RGB or inverted CMYK (as Adobe's programs
/// write it). Throws InputError, with `name` in front, if it is damaged, ends early or has more
/// than 500 scans.
DecodedImage decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace vlf
