#pragma once
// The container of the field file: named chunks, each a sequence of independently compressed and
// checksummed blocks, so that chunks are written and read in parallel and in constant space.
// Layout: docs/file-format.md.

#include "vlf/base/byte_sink.h"
#include "vlf/base/error.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vlf {

inline constexpr std::uint32_t kFormatVersion = 4;

/// Most bytes of a block before compression, and most bytes of memory it may fill.
inline constexpr std::size_t kMaxBlockBytes = std::size_t{1} << 20;

/// Most bytes that one stored byte may stand for. The writer pads what compresses better, so that
/// a file's size bounds the memory it can ask for.
inline constexpr std::size_t kMaxRatio = 1024;

/// A block before compression.
struct Block {
    std::vector<std::uint8_t> bytes;
    std::size_t memoryBytes = 0;  ///< what it fills once loaded
};

/// Where a block lies in the file.
struct StoredBlock {
    std::uint64_t offset = 0;
    std::uint32_t storedBytes = 0, rawBytes = 0, memoryBytes = 0;
    std::uint64_t checksum = 0;  ///< XXH3 of the stored bytes
};

struct Chunk {
    std::string name;
    bool critical = true;  ///< a reader that does not know it must refuse the file
    std::vector<StoredBlock> blocks;

    std::uint64_t storedBytes() const;
    std::uint64_t memoryBytes() const;
};

/// Puts chunks into one file. The same chunks give the same bytes, whatever the number of threads.
class ChunkFileWriter {
  public:
    /// 1: fast, to 22: small (Zstandard's). The level of field files is chosen on radiance: its
    /// residuals are noise to a matcher, and short matches cost more than literals. Level 3 is 4 %
    /// larger and 2.5 times as fast, level 9 is 1 % smaller and half as fast.
    explicit ChunkFileWriter(ByteSink& file, int compressionLevel = 6);

    /// Adds a chunk: encode(i) returns block i of `blockCount` and is called in parallel.
    /// Names have 1 to 16 characters of ASCII and are unique.
    void add(const std::string& name, std::size_t blockCount,
             const std::function<Block(std::size_t)>& encode, bool critical = true);

    /// Adds a chunk of plain bytes.
    void add(const std::string& name, std::span<const std::uint8_t> bytes);

    /// Completes the file; nothing may be added after it.
    void finish();

  private:
    ByteSink& file_;
    int compressionLevel_;
    std::vector<Chunk> chunks_;
};

/// Opens a file and checks its header and table; chunks are read on demand. Everything that is
/// wrong with the content throws InputError naming file and chunk; FileError if the file cannot
/// be read at all.
class ChunkFileReader {
  public:
    explicit ChunkFileReader(const std::string& path);
    ~ChunkFileReader();
    ChunkFileReader(ChunkFileReader&&) noexcept;

    const std::string& path() const { return path_; }
    std::uint64_t fileBytes() const { return fileBytes_; }
    const std::vector<Chunk>& chunks() const { return chunks_; }

    /// Throws if a critical chunk is not among `names`.
    void rejectUnknown(std::span<const std::string_view> names) const;

    bool has(std::string_view name) const;

    /// The chunk of that name. Throws if there is none.
    const Chunk& chunk(std::string_view name) const;

    /// The chunk, after checking that it has `blockCount` blocks that fill `memoryBytes`: only
    /// then may that memory be allocated.
    const Chunk& chunk(std::string_view name, std::uint64_t blockCount,
                       std::uint64_t memoryBytes) const;

    /// Calls decode(i, bytes) for every block i of the chunk, in parallel.
    using Decode = std::function<void(std::size_t, std::span<const std::uint8_t>)>;
    void read(const Chunk& chunk, const Decode& decode) const;

    /// The chunk's blocks one after the other.
    std::vector<std::uint8_t> readBytes(std::string_view name) const;

    SourceLocation where(const Chunk& chunk) const;

  private:
    class File;
    std::vector<std::uint8_t> readRange(std::uint64_t offset, std::size_t bytes) const;
    std::vector<std::uint8_t> readBlock(const Chunk& chunk, std::size_t index) const;
    void readTable();

    std::string path_;
    std::unique_ptr<File> file_;
    std::uint64_t fileBytes_ = 0;
    std::vector<Chunk> chunks_;
};

}  // namespace vlf
