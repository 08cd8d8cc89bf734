#include "fuzz/open_field_file.h"

#include "fuzz/scratch.h"

namespace vlf::fuzz {

std::vector<OpenChunk> openFieldFile(Bytes bytes) {
    const ChunkFileReader file(putFile("open.vlf", bytes));
    std::vector<OpenChunk> open;
    for (const Chunk& chunk : file.chunks()) {
        std::vector<Block> blocks(chunk.blocks.size());
        file.read(chunk, [&](std::size_t i, Bytes content) {
            blocks[i] = {{content.begin(), content.end()}, chunk.blocks[i].memoryBytes};
        });
        open.push_back({chunk.name, chunk.critical, std::move(blocks)});
    }
    return open;
}

Blob sealFieldFile(const std::vector<OpenChunk>& chunks) {
    MemorySink file;
    ChunkFileWriter writer(file);
    for (const OpenChunk& chunk : chunks)
        writer.add(
            chunk.name, chunk.blocks.size(), [&](std::size_t i) { return chunk.blocks[i]; },
            chunk.critical);
    writer.finish();
    return file.bytes();
}

}  // namespace vlf::fuzz
