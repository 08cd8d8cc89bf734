#include "hostile/damage.h"

#include "fuzz/open_field_file.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>

namespace vlf::test {

namespace {

constexpr std::size_t kLongestPart = 64;

constexpr std::string_view kNumbers[] = {
    "-1",    "0",     "1e39",       "-1e39",      "1e400",         "nan", "inf",
    "1e-46", "1e308", "4294967295", "2147483648", "1000000000000", "0.5", "99999999999999999999"};

constexpr std::uint32_t kIntegers[] = {0,       1,          2,          0xff,       0xffff,
                                       0x10000, 0x7fffffff, 0x80000000, 0xffffffff, 0x00ffffff};

bool isOfNumber(std::uint8_t c) {
    return std::isdigit(c) || c == '.' || c == '-';
}

}  // namespace

Blob Damage::of(const Blob& file, const Blob& other) {
    Blob bytes = file;
    for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times)
        damage(bytes, other);
    return bytes;
}

void Damage::damage(Blob& bytes, const Blob& other) {
    switch (below(9)) {
        case 0:
        case 1:
            return flipBit(bytes);
        case 2:
            return putExtremeByte(bytes);
        case 3:
            return putLyingInteger(bytes);
        case 4:
        case 5:
            return putLyingNumber(bytes);
        case 6:
            return removePart(bytes);
        case 7:
            return insertPart(bytes, below(2) == 0 ? bytes : other);
        default:
            if (below(4) == 0) bytes.resize(below(bytes.size()));
    }
}

void Damage::flipBit(Blob& bytes) {
    bytes[below(bytes.size())] ^= static_cast<std::uint8_t>(1 << below(8));
}

void Damage::putExtremeByte(Blob& bytes) {
    constexpr std::uint8_t kExtremes[] = {0, 1, 0x7f, 0x80, 0xff};
    bytes[below(bytes.size())] = kExtremes[below(std::size(kExtremes))];
}

void Damage::putLyingInteger(Blob& bytes) {
    if (bytes.size() < 4) return flipBit(bytes);
    const std::size_t at = below(bytes.size() - 3);
    const std::uint32_t value = kIntegers[below(std::size(kIntegers))];
    const bool bigEndian = below(2) == 0;
    for (std::size_t i = 0; i < 4; ++i)
        bytes[at + i] = static_cast<std::uint8_t>(value >> 8 * (bigEndian ? 3 - i : i));
}

/// In place of a number that is written out.
void Damage::putLyingNumber(Blob& bytes) {
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
    const auto first = std::find_if(from, bytes.end(), isOfNumber);
    if (first == bytes.end()) return flipBit(bytes);
    const std::string_view number = kNumbers[below(std::size(kNumbers))];
    const auto rest = bytes.erase(first, std::find_if_not(first, bytes.end(), isOfNumber));
    bytes.insert(rest, number.begin(), number.end());
}

void Damage::removePart(Blob& bytes) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(bytes.size() - at, 1 + below(kLongestPart));
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    bytes.erase(first, first + static_cast<std::ptrdiff_t>(length));
}

void Damage::insertPart(Blob& bytes, const Blob& from) {
    if (from.empty()) return;
    const std::size_t start = below(from.size());
    const std::size_t length = std::min(from.size() - start, 1 + below(kLongestPart));
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(start);
    const Blob part(first, first + static_cast<std::ptrdiff_t>(length));
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size())), part.begin(),
                 part.end());
}

Blob Damage::behindChecksums(const Blob& file, const Blob& other) {
    std::vector<fuzz::OpenChunk> chunks = fuzz::openFieldFile(file);
    const std::vector<fuzz::OpenChunk> others = fuzz::openFieldFile(other);
    fuzz::OpenChunk& chunk = chunks[below(chunks.size())];
    fuzz::OpenChunk& second = chunks[below(chunks.size())];
    switch (below(10)) {
        case 0:
            std::swap(chunk.name, second.name);
            break;
        case 1:
            std::swap(chunk, second);
            break;
        case 2:
            chunk = others[below(others.size())];
            break;
        case 3:
            if (!chunk.blocks.empty())
                chunk.blocks[below(chunk.blocks.size())].memoryBytes = below(kMaxBlockBytes + 1);
            break;
        default:
            for (Block& block : chunk.blocks)
                block.bytes =
                    of(block.bytes, second.blocks.empty() ? Blob{} : second.blocks[0].bytes);
    }
    return fuzz::sealFieldFile(chunks);
}

}  // namespace vlf::test
