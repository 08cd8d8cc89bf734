#pragma once
// What the writer and the reader of chunks share: the header, the table's entries, the checksum.

#include "vlf/io/byte_stream.h"
#include "vlf/io/chunk_file.h"

#include <array>

#include <xxhash.h>

namespace vlf {

inline constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'V', 'L', 'F', '\r', '\n', 0x1a, '\n'};
inline constexpr std::size_t kHeaderBytes = 48, kNameBytes = 16;

inline constexpr const char* kDamaged = "the file is damaged; copy it again or bake it again";

inline std::uint64_t checksum(std::span<const std::uint8_t> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

/// The start of a file; the checksum of these bytes follows.
struct Header {
    std::array<std::uint8_t, 8> magic = kMagic;
    std::uint32_t version = kFormatVersion, chunkCount = 0;
    std::uint64_t tableOffset = 0, tableBytes = 0, tableChecksum = 0;
};

template <class S>
void describe(S& s, Field<S, Header> h) {
    for (auto& byte : h.magic) s(byte);
    s(h.version, h.chunkCount, h.tableOffset, h.tableBytes, h.tableChecksum);
}

template <class S>
void describe(S& s, Field<S, StoredBlock> b) {
    s(b.storedBytes, b.rawBytes, b.memoryBytes, b.checksum);
}

}  // namespace vlf
