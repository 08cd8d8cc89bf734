// Layout: ITU-T T.81, annex B. A file is a list of segments (0xff, marker, two bytes of length that
// count themselves, content); those of scans are followed by coded data, in which 0xff is followed
// by 0 or a restart marker.

#include "vlf/image/jpeg_header.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <numeric>

namespace vlf {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint8_t kHuffmanTables = 0xc4, kScan = 0xda, kEnd = 0xd9;
constexpr int kMostScans = 500;  // encoders write about ten

bool isMarker(std::uint8_t code) {
    const bool isRestart = code >= 0xd0 && code <= 0xd7;
    return code != 0 && code != 0xff && !isRestart;
}

/// Drops all up to the next marker and returns it; kEnd if there is none.
std::uint8_t takeMarker(Bytes& rest) {
    for (std::size_t i = 0; i + 1 < rest.size(); ++i) {
        if (rest[i] != 0xff || !isMarker(rest[i + 1])) continue;
        const std::uint8_t marker = rest[i + 1];
        rest = rest.subspan(i + 2);
        return marker;
    }
    return kEnd;
}

/// Tables of 1 byte of class and number, 16 numbers of codes by length, and the codes' values.
/// `length` is what the segment claims.
void checkTables(Bytes rest, std::size_t length, const std::string& name) {
    constexpr std::size_t kLengths = 16, kMostCodes = 256;
    for (std::size_t at = 2; at < length && at + 1 < rest.size();) {
        const Bytes counts = rest.subspan(at + 1, std::min(kLengths, rest.size() - at - 1));
        const auto codes = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
        if (codes > kMostCodes)
            throw InputError(name + ": damaged image: a Huffman table of " + std::to_string(codes) +
                             " codes");
        at += 1 + kLengths + codes;
    }
}

}  // namespace

bool isJpeg(Bytes bytes) {
    return bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
}

void checkJpegHeader(Bytes bytes, const std::string& name) {
    int scans = 0;
    Bytes rest = bytes.subspan(2);
    for (std::uint8_t marker; (marker = takeMarker(rest)) != kEnd && rest.size() >= 2;) {
        const std::size_t length = std::size_t{rest[0]} << 8 | rest[1];
        if (marker == kHuffmanTables) checkTables(rest, length, name);
        if (marker == kScan && ++scans > kMostScans)
            throw InputError(name + ": JPEG of more than " + std::to_string(kMostScans) +
                             " scans; save it anew");
        rest = rest.subspan(std::min(length, rest.size()));
    }
}

}  // namespace vlf
