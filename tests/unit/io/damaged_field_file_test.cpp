// Field files damaged in every way that is cheap to enumerate: reading them gives an InputError or
// the data that was written, and nothing else. Run under the sanitizers these are the tests that
// no index of a file leads out of bounds.

#include "vlf/io/field_file.h"

#include "unit/io/example_room.h"
#include "unit/io/temp_folder.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/io/chunk_file.h"

#include <functional>

#include <gtest/gtest.h>

namespace vlf {
namespace {

using test::putBytes;
using test::TempFolder;

constexpr test::ExampleSize kTiny = {
    .texelsPerMetre = 1, .lines = 3, .cells = 6, .tileSize = 4, .textureSide = 4};

class DamagedFieldFile : public testing::Test {
  protected:
    void SetUp() override {
        writeField(path, test::makeExampleRoom(kTiny));
        bytes = readFile(path);
    }
    /// Whether the file at `path` is refused; anything but an InputError fails the test.
    bool isRefused() const {
        try {
            readField(path);
            return false;
        } catch (const InputError& e) {
            EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
            return true;
        }
    }
    TempFolder folder;
    std::string path = folder.file("room.vlf");
    std::vector<std::uint8_t> bytes;
};

TEST_F(DamagedFieldFile, TruncatedAnywhereIsRefused) {
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        putBytes(path, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)});
        ASSERT_TRUE(isRefused()) << "at " << length << " of " << bytes.size();
    }
}

TEST_F(DamagedFieldFile, WithABitFlippedAnywhereIsRefused) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::vector<std::uint8_t> damaged = bytes;
        damaged[i] ^= static_cast<std::uint8_t>(1 << i % 8);
        putBytes(path, damaged);
        ASSERT_TRUE(isRefused()) << "byte " << i << " of " << bytes.size();
    }
}

TEST_F(DamagedFieldFile, WithSomethingAppendedIsRefused) {
    bytes.push_back(0);
    putBytes(path, bytes);
    EXPECT_TRUE(isRefused());
}

/// The file's chunks, with one of them altered and everything sealed with right checksums.
void rewrite(const ChunkFileReader& source, const std::string& name, const std::string& path,
             const std::function<void(std::vector<std::uint8_t>&)>& alter) {
    MemorySink file;
    ChunkFileWriter writer(file);
    for (const Chunk& chunk : source.chunks()) {
        std::vector<std::uint8_t> content = source.readBytes(chunk.name);
        if (chunk.name == name) alter(content);
        const std::size_t memory = chunk.memoryBytes();
        writer.add(chunk.name, chunk.blocks.size(),
                   [&](std::size_t) { return Block{content, memory}; });
    }
    writer.finish();
    putBytes(path, file.bytes());
}

/// Chunks of this small a file have one block at most, which rewrite() relies on.
TEST_F(DamagedFieldFile, WithAnyByteOfAnyChunkForgedIsRefusedOrSound) {
    putBytes(folder.file("source.vlf"), bytes);
    const ChunkFileReader source(folder.file("source.vlf"));
    int refused = 0, accepted = 0;
    for (const Chunk& chunk : source.chunks()) {
        ASSERT_LE(chunk.blocks.size(), 1u);
        const std::size_t size = source.readBytes(chunk.name).size();
        const std::size_t step = size > 150 ? size / 75 : 1;
        for (std::size_t i = 0; i < size; i += step)
            for (const std::uint8_t value : {0x00, 0xff}) {
                rewrite(source, chunk.name, path, [&](auto& content) { content[i] = value; });
                ++(isRefused() ? refused : accepted);
            }
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(accepted, 100);
}

TEST_F(DamagedFieldFile, WithAChunkOfAnotherLengthIsRefused) {
    putBytes(folder.file("source.vlf"), bytes);
    const ChunkFileReader source(folder.file("source.vlf"));
    for (const Chunk& chunk : source.chunks()) {
        if (chunk.blocks.empty()) continue;
        rewrite(source, chunk.name, path, [](auto& content) { content.pop_back(); });
        EXPECT_TRUE(isRefused()) << chunk.name << " shortened";
        rewrite(source, chunk.name, path, [](auto& content) { content.push_back(0); });
        EXPECT_TRUE(isRefused()) << chunk.name << " lengthened";
    }
}

TEST_F(DamagedFieldFile, WithoutOneOfItsChunksIsRefusedByName) {
    putBytes(folder.file("source.vlf"), bytes);
    const ChunkFileReader source(folder.file("source.vlf"));
    for (const Chunk& missing : source.chunks()) {
        MemorySink file;
        ChunkFileWriter writer(file);
        for (const Chunk& chunk : source.chunks())
            if (chunk.name != missing.name) writer.add(chunk.name, source.readBytes(chunk.name));
        writer.finish();
        putBytes(path, file.bytes());
        EXPECT_TRUE(isRefused()) << missing.name;
    }
}

TEST_F(DamagedFieldFile, WithAnUnknownChunkIsRefused) {
    putBytes(folder.file("source.vlf"), bytes);
    const ChunkFileReader source(folder.file("source.vlf"));
    MemorySink file;
    ChunkFileWriter writer(file);
    for (const Chunk& chunk : source.chunks()) writer.add(chunk.name, source.readBytes(chunk.name));
    writer.add("glossy", std::vector<std::uint8_t>(10));
    writer.finish();
    putBytes(path, file.bytes());
    try {
        readField(path);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("chunk glossy: unknown"), std::string::npos);
    }
}

}  // namespace
}  // namespace vlf
