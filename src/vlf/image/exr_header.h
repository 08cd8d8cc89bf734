#pragma once
// OpenEXR 3.1 takes memory for whatever a header claims before it looks at the size of the file.

#include <cstdint>
#include <span>
#include <string>

namespace vlf {

/// Throws InputError, with `name` in front, unless every attribute in the headers of all parts
/// lies within the file, those of fixed size have it, and data windows and tiles are of a size that
/// the file can hold (see requireImageSize), or if data are deep. The bytes begin with the magic
/// number.
void checkExrHeader(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace vlf
