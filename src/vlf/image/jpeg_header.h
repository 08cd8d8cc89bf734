#pragma once
// What stb_image trusts a JPEG with: tables that are copied without regard to their size, and scans
// that are walks through all blocks however short they are.

#include <cstdint>
#include <span>
#include <string>

namespace vlf {

/// True for bytes that begin like a JPEG file.
bool isJpeg(std::span<const std::uint8_t> bytes);

/// Throws InputError, with `name` in front, if a Huffman table has more than its 256 codes or there
/// are more than 500 scans. The bytes begin like a JPEG.
void checkJpegHeader(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace vlf
