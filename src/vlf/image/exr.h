#pragma once
// OpenEXR files in memory; image_io.h puts them on disk.

#include "vlf/image/image_io.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vlf {

/// True for bytes that begin like an EXR file.
bool isExr(std::span<const std::uint8_t> bytes);

/// The first part of a flat file, scan lines or tiles, as described at readImage. Throws
/// InputError, with `name` in front.
Image decodeExr(std::span<const std::uint8_t> bytes, const std::string& name);

/// Throws InputError if the image is empty.
std::vector<std::uint8_t> encodeExr(const Image& image, const ImageAttributes& attributes);

}  // namespace vlf
