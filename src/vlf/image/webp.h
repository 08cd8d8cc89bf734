#pragma once
// WebP files in memory.

#include "vlf/image/image_io.h"

#include <cstdint>
#include <span>
#include <string>

namespace vlf {

/// True for bytes that begin like a WebP file.
bool isWebp(std::span<const std::uint8_t> bytes);

/// A still picture, as sRGB-encoded bytes. Throws InputError, with `name` in front.
DecodedImage decodeWebp(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace vlf
