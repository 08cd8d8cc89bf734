#include "vlf/io/chunk_file.h"

#include "unit/io/temp_folder.h"

#include <array>
#include <cstring>
#include <numeric>

#include <gtest/gtest.h>
#include <xxhash.h>

namespace vlf {
namespace {

using test::putBytes;
using test::TempFolder;

std::vector<std::uint8_t> ramp(std::size_t count) {
    std::vector<std::uint8_t> bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(i * i >> 3);
    return bytes;
}

template <class T>
void poke(std::vector<std::uint8_t>& bytes, std::size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
}

template <class T>
T peek(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// Makes the checksums of table and header right again.
void reseal(std::vector<std::uint8_t>& bytes) {
    const auto table = peek<std::uint64_t>(bytes, 16);
    poke(bytes, 32, XXH3_64bits(bytes.data() + table, bytes.size() - table));
    poke(bytes, 40, XXH3_64bits(bytes.data(), 40));
}

std::string messageOf(const std::string& path) {
    try {
        const ChunkFileReader reader(path);
        for (const Chunk& chunk : reader.chunks()) reader.readBytes(chunk.name);
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

/// A file of one chunk "bytes" of one block, and where the entry of that block begins.
class OneChunk : public testing::Test {
  protected:
    void SetUp() override {
        MemorySink file;
        ChunkFileWriter writer(file);
        writer.add("bytes", ramp(5000));
        writer.finish();
        bytes = file.bytes();
        putBytes(path, bytes);
        blockEntry = peek<std::uint64_t>(bytes, 16) + 24;
    }
    std::string messageOfChanged() {
        reseal(bytes);
        putBytes(path, bytes);
        return messageOf(path);
    }
    TempFolder folder;
    std::string path = folder.file("one.vlf");
    std::vector<std::uint8_t> bytes;
    std::size_t blockEntry = 0;
};

TEST_F(OneChunk, ReadsBack) {
    EXPECT_EQ(ChunkFileReader(path).readBytes("bytes"), ramp(5000));
    EXPECT_EQ(ChunkFileReader(path).chunk("bytes").memoryBytes(), 5000u);
}

TEST_F(OneChunk, HasTheDocumentedHeader) {
    const std::array<std::uint8_t, 8> magic = {0x89, 'V', 'L', 'F', '\r', '\n', 0x1a, '\n'};
    EXPECT_TRUE(std::equal(magic.begin(), magic.end(), bytes.begin()));
    EXPECT_EQ(peek<std::uint32_t>(bytes, 8), kFormatVersion);
    EXPECT_EQ(peek<std::uint32_t>(bytes, 12), 1u);
    EXPECT_EQ(peek<std::uint64_t>(bytes, 16) + peek<std::uint64_t>(bytes, 24), bytes.size());
}

TEST_F(OneChunk, AnotherVersionIsRefusedByName) {
    poke(bytes, 8, kFormatVersion + 1);
    EXPECT_NE(messageOfChanged().find("format version " + std::to_string(kFormatVersion + 1)), std::string::npos);
}

TEST_F(OneChunk, AnotherKindOfFileIsRefused) {
    putBytes(path, ramp(1000));
    EXPECT_NE(messageOf(path).find("not a .vlf"), std::string::npos);
    putBytes(path, {});
    EXPECT_NE(messageOf(path).find("too short"), std::string::npos);
}

TEST_F(OneChunk, ABlockThatClaimsMoreThanItsBytesJustifyIsRefused) {
    for (const std::uint32_t claim : {0xffffffffu, 2u << 20, 1u << 20})
        for (const std::size_t field : {4, 8}) {
            const auto honest = bytes;
            poke(bytes, blockEntry, std::uint32_t{1000});
            poke(bytes, blockEntry + field, claim);
            EXPECT_NE(messageOfChanged().find("impossible block size"), std::string::npos);
            bytes = honest;
        }
}

TEST_F(OneChunk, ASmallerOrLargerContentThanClaimedIsRefused) {
    for (const std::uint32_t claim : {0u, 4999u, 5001u}) {
        poke(bytes, blockEntry + 4, claim);
        EXPECT_NE(messageOfChanged().find("does not decompress"), std::string::npos) << claim;
    }
}

TEST_F(OneChunk, BlocksMustFillTheFile) {
    poke(bytes, blockEntry, peek<std::uint32_t>(bytes, blockEntry) - 1);
    EXPECT_NE(messageOfChanged().find("does not cover"), std::string::npos);
}

TEST_F(OneChunk, ALyingNumberOfChunksOrBlocksIsRefused) {
    const auto honest = bytes;
    poke(bytes, 12, 0xffffffffu);
    EXPECT_NE(messageOfChanged(), "");
    bytes = honest;
    poke(bytes, blockEntry - 4, 0xffffffffu);
    EXPECT_NE(messageOfChanged(), "");
    bytes = honest;
    poke(bytes, 12, 0u);
    EXPECT_NE(messageOfChanged(), "");
}

TEST_F(OneChunk, ALyingTableOffsetIsRefused) {
    for (const std::uint64_t offset : {0ull, 47ull, ~0ull, 1ull << 40}) {
        poke(bytes, 16, offset);
        poke(bytes, 40, XXH3_64bits(bytes.data(), 40));
        putBytes(path, bytes);
        EXPECT_NE(messageOf(path), "") << offset;
    }
}

TEST(ChunkFile, SplitsIntoBlocksOfAMegabyte) {
    const TempFolder folder;
    const std::vector<std::uint8_t> content = ramp(2 * kMaxBlockBytes + 77);
    MemorySink file;
    ChunkFileWriter writer(file);
    writer.add("long", content);
    writer.add("empty", std::vector<std::uint8_t>{});
    writer.finish();
    putBytes(folder.file("a.vlf"), file.bytes());
    const ChunkFileReader reader(folder.file("a.vlf"));
    EXPECT_EQ(reader.chunk("long").blocks.size(), 3u);
    EXPECT_EQ(reader.readBytes("long"), content);
    EXPECT_TRUE(reader.readBytes("empty").empty());
    EXPECT_TRUE(reader.has("empty"));
    EXPECT_FALSE(reader.has("missing"));
    EXPECT_THROW(reader.chunk("missing"), InputError);
}

TEST(ChunkFile, HighlyCompressibleBlocksArePaddedToTheAllowedRatio) {
    const TempFolder folder;
    MemorySink file;
    ChunkFileWriter writer(file);
    writer.add("zeros", std::vector<std::uint8_t>(kMaxBlockBytes));
    writer.finish();
    putBytes(folder.file("a.vlf"), file.bytes());
    const ChunkFileReader reader(folder.file("a.vlf"));
    EXPECT_EQ(reader.readBytes("zeros"), std::vector<std::uint8_t>(kMaxBlockBytes));
    EXPECT_GE(reader.chunk("zeros").storedBytes(), kMaxBlockBytes / kMaxRatio);
    EXPECT_LE(reader.chunk("zeros").storedBytes(), 2 * kMaxBlockBytes / kMaxRatio);
}

TEST(ChunkFile, UnknownCriticalChunksAreRefusedAndOthersIgnored) {
    const TempFolder folder;
    const std::array<std::string_view, 1> known = {"known"};
    for (const bool critical : {false, true}) {
        MemorySink file;
        ChunkFileWriter writer(file);
        writer.add("known", ramp(10));
        writer.add("extra", 1, [](std::size_t) { return Block{ramp(10), 10}; }, critical);
        writer.finish();
        putBytes(folder.file("a.vlf"), file.bytes());
        const ChunkFileReader reader(folder.file("a.vlf"));
        if (critical) {
            EXPECT_THROW(reader.rejectUnknown(known), InputError);
        } else {
            EXPECT_NO_THROW(reader.rejectUnknown(known));
        }
    }
}

TEST(ChunkFile, TheSameNameTwiceIsRefused) {
    const TempFolder folder;
    MemorySink file;
    ChunkFileWriter writer(file);
    writer.add("a", ramp(10));
    writer.add("a", ramp(10));
    writer.finish();
    putBytes(folder.file("a.vlf"), file.bytes());
    EXPECT_NE(messageOf(folder.file("a.vlf")).find("twice"), std::string::npos);
}

TEST(ChunkFile, WhatCannotBeOpenedIsAFileError) {
    const TempFolder folder;
    EXPECT_THROW(ChunkFileReader(folder.file("missing.vlf")), FileError);
    EXPECT_THROW(ChunkFileReader(folder.file("")), FileError);
    EXPECT_THROW(ChunkFileReader("/dev/zero"), FileError);
}

}  // namespace
}  // namespace vlf
