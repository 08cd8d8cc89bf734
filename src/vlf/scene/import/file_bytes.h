#pragma once
// Whole input files in memory.

#include <cstdint>
#include <string>
#include <vector>

namespace vlf {

/// Largest scene or buffer file that is read, in bytes (the containers of glTF count in 32 bits).
inline constexpr std::uint64_t kMaxFileBytes = 0xffffffffull;

/// The bytes of a regular file. Throws FileError if it is missing, not a regular file, unreadable
/// or larger than kMaxFileBytes.
std::vector<std::uint8_t> readFileBytes(const std::string& path);

/// The same as text. Throws InputError if it is not 8-bit text (UTF-16, binary data).
std::string readFileText(const std::string& path);

}  // namespace vlf
