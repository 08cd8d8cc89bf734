#include "vlf/base/parallel.h"
#include "vlf/io/chunk_format.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include <zstd.h>

namespace vlf {

namespace {

constexpr int kMinMatch = 6;

/// Blocks compressed before they are appended: enough work for every thread, little memory.
constexpr std::size_t kBatch = 256;

void append(std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& bytes) {
    to.insert(to.end(), bytes.begin(), bytes.end());
}

/// Appends a skippable frame, which decompressors ignore (RFC 8878, 3.1.2), to reach `size`.
void padTo(std::vector<std::uint8_t>& frames, std::size_t size) {
    constexpr std::size_t kFrameHeader = 8;
    if (frames.size() >= size) return;
    const std::size_t content = size - std::min(size, frames.size() + kFrameHeader);
    append(frames, bytesOf(std::uint32_t{ZSTD_MAGIC_SKIPPABLE_START}));
    append(frames, bytesOf(static_cast<std::uint32_t>(content)));
    frames.resize(frames.size() + content);
}

std::vector<std::uint8_t> compress(const Block& block, int level) {
    if (block.bytes.size() > kMaxBlockBytes || block.memoryBytes > kMaxBlockBytes)
        throw std::logic_error("a block of a field file is too large");
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                       &ZSTD_freeCCtx);
    if (!context) throw std::bad_alloc();
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_minMatch, kMinMatch);
    std::vector<std::uint8_t> frames(ZSTD_compressBound(block.bytes.size()));
    const std::size_t size = ZSTD_compress2(context.get(), frames.data(), frames.size(),
                                            block.bytes.data(), block.bytes.size());
    if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
    frames.resize(size);
    frames.shrink_to_fit();
    const std::size_t most = std::max(block.bytes.size(), block.memoryBytes);
    padTo(frames, (most + kMaxRatio - 1) / kMaxRatio);
    return frames;
}

std::vector<std::uint8_t> tableOf(const std::vector<Chunk>& chunks) {
    ByteWriter table;
    for (const Chunk& chunk : chunks) {
        for (std::size_t i = 0; i < kNameBytes; ++i)
            table(i < chunk.name.size() ? chunk.name[i] : '\0');
        table(static_cast<std::uint32_t>(chunk.critical),
              static_cast<std::uint32_t>(chunk.blocks.size()));
        for (const StoredBlock& block : chunk.blocks) table(block);
    }
    return table.take();
}

}  // namespace

ChunkFileWriter::ChunkFileWriter(ByteSink& file, int compressionLevel)
    : file_(file), compressionLevel_(compressionLevel) {
    file_.append(std::vector<std::uint8_t>(kHeaderBytes));
}

void ChunkFileWriter::add(const std::string& name, std::size_t blockCount,
                          const std::function<Block(std::size_t)>& encode, bool critical) {
    if (name.empty() || name.size() > kNameBytes) throw std::logic_error("bad chunk name " + name);
    Chunk& chunk = chunks_.emplace_back(Chunk{name, critical, {}});
    chunk.blocks.resize(blockCount);
    std::vector<std::vector<std::uint8_t>> batch(std::min(kBatch, blockCount));
    for (std::size_t first = 0; first < blockCount; first += kBatch) {
        const std::size_t count = std::min(kBatch, blockCount - first);
        parallelFor(count, [&](std::size_t i) {
            const Block block = encode(first + i);
            batch[i] = compress(block, compressionLevel_);
            chunk.blocks[first + i] = {0, static_cast<std::uint32_t>(batch[i].size()),
                                       static_cast<std::uint32_t>(block.bytes.size()),
                                       static_cast<std::uint32_t>(block.memoryBytes),
                                       checksum(batch[i])};
        });
        for (std::size_t i = 0; i < count; ++i) file_.append(batch[i]);
    }
}

void ChunkFileWriter::add(const std::string& name, std::span<const std::uint8_t> bytes) {
    add(name, (bytes.size() + kMaxBlockBytes - 1) / kMaxBlockBytes, [&](std::size_t i) {
        const auto part = bytes.subspan(
            i * kMaxBlockBytes, std::min(kMaxBlockBytes, bytes.size() - i * kMaxBlockBytes));
        return Block{{part.begin(), part.end()}, part.size()};
    });
}

void ChunkFileWriter::finish() {
    const std::vector<std::uint8_t> table = tableOf(chunks_);
    Header header;
    header.chunkCount = static_cast<std::uint32_t>(chunks_.size());
    header.tableOffset = file_.size();
    header.tableBytes = table.size();
    header.tableChecksum = checksum(table);
    std::vector<std::uint8_t> bytes = bytesOf(header);
    append(bytes, bytesOf(checksum(bytes)));
    file_.append(table);
    file_.writeStart(bytes);
}

}  // namespace vlf
