#pragma once
// Radiance HDR (RGBE) files in memory. stb's decoder is not used for them: it accepts files that
// end early and can loop for ever on them.

#include "vlf/image/image.h"

#include <cstdint>
#include <span>
#include <string>

namespace vlf {

/// True for bytes that begin like a Radiance file.
bool isRadianceHdr(std::span<const std::uint8_t> bytes);

/// Linear RGB as stored. Read are pictures of format 32-bit_rle_rgbe with rows from the top, flat
/// or run-length encoded per component. Throws InputError, with `name` in front.
/// [Ward 1991, Real pixels, Graphics Gems II]
Image decodeRadianceHdr(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace vlf
