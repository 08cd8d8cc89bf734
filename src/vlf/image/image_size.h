#pragma once
// The check of a size that an image file claims, before memory is taken for it.

#include "vlf/base/error.h"
#include "vlf/image/image_io.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace vlf {

/// Deflate yields at most 1032 bytes per byte, that is 8256 pixels of one bit; no other coding of
/// the formats that are read comes near.
inline constexpr double kMaxPixelsPerByte = 16384;

/// Throws InputError if the size is not positive, beyond kMaxPixels, or beyond what a file of
/// `fileBytes` bytes can hold at `pixelsPerByte`.
inline void requireImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes,
                             const std::string& name, double pixelsPerByte = kMaxPixelsPerByte) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width <= 0 || height <= 0) throw InputError(name + ": image of size " + size);
    const double pixels = static_cast<double>(width) * static_cast<double>(height);
    if (pixels > static_cast<double>(kMaxPixels))
        throw InputError(name + ": image of " + size + " pixels is too large, at most " +
                         std::to_string(kMaxPixels) + " are read; make it smaller");
    if (pixels > pixelsPerByte * static_cast<double>(fileBytes))
        throw InputError(name + ": damaged image: too short for " + size + " pixels");
}

}  // namespace vlf
