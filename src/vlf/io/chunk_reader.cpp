#include "vlf/base/parallel.h"
#include "vlf/io/chunk_format.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

namespace vlf {

std::uint64_t Chunk::storedBytes() const {
    std::uint64_t sum = 0;
    for (const StoredBlock& block : blocks) sum += block.storedBytes;
    return sum;
}

std::uint64_t Chunk::memoryBytes() const {
    std::uint64_t sum = 0;
    for (const StoredBlock& block : blocks) sum += block.memoryBytes;
    return sum;
}

/// A file that several threads may read at once.
class ChunkFileReader::File {
  public:
    explicit File(const std::string& path) : path_(path) {
        // Non-blocking: opening a pipe must not wait for somebody to write to it.
        descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
        if (descriptor_ < 0) fail();
    }
    ~File() { ::close(descriptor_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    std::uint64_t size() const {
        struct stat status {};
        if (::fstat(descriptor_, &status) != 0) fail();
        if (!S_ISREG(status.st_mode)) throw FileError(path_, "cannot read: not a regular file");
        return static_cast<std::uint64_t>(status.st_size);
    }

    void read(std::uint64_t offset, std::span<std::uint8_t> bytes) const {
        while (!bytes.empty()) {
            const ssize_t n =
                ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) fail();
            if (n == 0) throw InputError(SourceLocation{path_, 0, ""}, "ends early: " + damaged());
            bytes = bytes.subspan(static_cast<std::size_t>(n));
            offset += static_cast<std::uint64_t>(n);
        }
    }

  private:
    static std::string damaged() { return kDamaged; }
    [[noreturn]] void fail() const {
        throw FileError(path_, std::string("cannot read: ") + std::strerror(errno));
    }

    std::string path_;
    int descriptor_ = -1;
};

ChunkFileReader::ChunkFileReader(const std::string& path)
    : path_(path), file_(std::make_unique<File>(path)), fileBytes_(file_->size()) {
    readTable();
}

ChunkFileReader::~ChunkFileReader() = default;
ChunkFileReader::ChunkFileReader(ChunkFileReader&&) noexcept = default;

std::vector<std::uint8_t> ChunkFileReader::readRange(std::uint64_t offset,
                                                     std::size_t bytes) const {
    std::vector<std::uint8_t> range(bytes);
    file_->read(offset, range);
    return range;
}

namespace {

void checkBlock(const StoredBlock& block, const SourceLocation& where) {
    const std::size_t most = std::max(block.rawBytes, block.memoryBytes);
    if (block.storedBytes == 0 || most > kMaxBlockBytes || most > kMaxRatio * block.storedBytes ||
        block.storedBytes > ZSTD_compressBound(kMaxBlockBytes))
        throw InputError(where, std::string("impossible block size: ") + kDamaged);
}

Header parseHeader(std::span<const std::uint8_t> bytes, std::uint64_t fileBytes,
                   const SourceLocation& where) {
    Header header;
    ByteReader reader(bytes, where);
    std::uint64_t seal = 0;
    reader(header, seal);
    if (header.magic != kMagic) throw InputError(where, "not a .vlf field file");
    if (header.version != kFormatVersion)
        throw InputError(where, "format version " + std::to_string(header.version) +
                                    ", but this program reads version " +
                                    std::to_string(kFormatVersion) +
                                    "; bake the scene again or use the program that wrote it");
    if (seal != checksum(bytes.first(kHeaderBytes - sizeof seal)))
        throw InputError(where, std::string("header checksum wrong: ") + kDamaged);
    if (header.tableBytes > fileBytes - kHeaderBytes ||
        header.tableOffset != fileBytes - header.tableBytes)
        throw InputError(where, std::string("not as long as its header says: ") + kDamaged);
    return header;
}

Chunk parseChunk(ByteReader& reader, std::uint64_t& offset, const std::string& path) {
    Chunk chunk;
    std::uint32_t critical = 0, blockCount = 0;
    for (std::size_t i = 0; i < kNameBytes; ++i) {
        char c = 0;
        reader(c);
        if (c != '\0') chunk.name += c;
    }
    reader(critical, blockCount);
    chunk.critical = critical != 0;
    for (std::uint32_t i = 0; i < blockCount; ++i) {
        StoredBlock& block = chunk.blocks.emplace_back();
        reader(block);
        checkBlock(block, {path, 0, "chunk " + chunk.name});
        block.offset = offset;
        offset += block.storedBytes;
    }
    return chunk;
}

}  // namespace

void ChunkFileReader::readTable() {
    const SourceLocation header{path_, 0, ""}, tableAt{path_, 0, "table of chunks"};
    if (fileBytes_ < kHeaderBytes) throw InputError(header, "too short to be a .vlf field file");
    const Header h = parseHeader(readRange(0, kHeaderBytes), fileBytes_, header);
    const std::vector<std::uint8_t> table = readRange(h.tableOffset, h.tableBytes);
    if (checksum(table) != h.tableChecksum)
        throw InputError(tableAt, std::string("checksum wrong: ") + kDamaged);
    ByteReader reader(table, tableAt);
    std::uint64_t offset = kHeaderBytes;
    std::set<std::string> names;
    for (std::uint32_t i = 0; i < h.chunkCount; ++i) {
        chunks_.push_back(parseChunk(reader, offset, path_));
        if (!names.insert(chunks_.back().name).second)
            throw InputError(where(chunks_.back()), std::string("occurs twice: ") + kDamaged);
    }
    reader.expectEnd();
    if (offset != h.tableOffset)
        throw InputError(tableAt, std::string("does not cover the file: ") + kDamaged);
}

SourceLocation ChunkFileReader::where(const Chunk& chunk) const {
    return {path_, 0, "chunk " + chunk.name};
}

void ChunkFileReader::rejectUnknown(std::span<const std::string_view> names) const {
    for (const Chunk& chunk : chunks_)
        if (chunk.critical && std::find(names.begin(), names.end(), chunk.name) == names.end())
            throw InputError(where(chunk),
                             "unknown to this program; use the program that wrote the file");
}

bool ChunkFileReader::has(std::string_view name) const {
    return std::any_of(chunks_.begin(), chunks_.end(),
                       [&](const Chunk& chunk) { return chunk.name == name; });
}

const Chunk& ChunkFileReader::chunk(std::string_view name) const {
    for (const Chunk& chunk : chunks_)
        if (chunk.name == name) return chunk;
    throw InputError({path_, 0, "chunk " + std::string(name)}, std::string("missing: ") + kDamaged);
}

const Chunk& ChunkFileReader::chunk(std::string_view name, std::uint64_t blockCount,
                                    std::uint64_t memoryBytes) const {
    const Chunk& found = chunk(name);
    if (found.blocks.size() != blockCount || found.memoryBytes() != memoryBytes)
        throw InputError(where(found),
                         "not of the size that the chunk \"summary\" announces: bake it again");
    return found;
}

std::vector<std::uint8_t> ChunkFileReader::readBlock(const Chunk& chunk, std::size_t index) const {
    const StoredBlock& block = chunk.blocks[index];
    const std::vector<std::uint8_t> stored = readRange(block.offset, block.storedBytes);
    if (checksum(stored) != block.checksum)
        throw InputError(where(chunk),
                         "checksum of block " + std::to_string(index) + " wrong: " + kDamaged);
    std::vector<std::uint8_t> bytes(block.rawBytes);
    const std::size_t size =
        ZSTD_decompress(bytes.data(), bytes.size(), stored.data(), stored.size());
    if (ZSTD_isError(size) || size != bytes.size())
        throw InputError(where(chunk),
                         "block " + std::to_string(index) + " does not decompress: " + kDamaged);
    return bytes;
}

void ChunkFileReader::read(const Chunk& chunk, const Decode& decode) const {
    parallelFor(chunk.blocks.size(), [&](std::size_t i) { decode(i, readBlock(chunk, i)); });
}

std::vector<std::uint8_t> ChunkFileReader::readBytes(std::string_view name) const {
    const Chunk& found = chunk(name);
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < found.blocks.size(); ++i) {
        const std::vector<std::uint8_t> block = readBlock(found, i);
        bytes.insert(bytes.end(), block.begin(), block.end());
    }
    return bytes;
}

}  // namespace vlf
