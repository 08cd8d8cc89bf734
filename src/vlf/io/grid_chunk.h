#pragma once
// Grids of structs as chunks. A struct is turned into an array of integers (a code) and back by
// two functions; a grid is cut into blocks of whole rows. An array is a grid of one column.

#include "vlf/io/chunk_file.h"
#include "vlf/io/grid_codec.h"

#include <bit>

namespace vlf {

/// Row-major items; `width` and `height` in [0, 2³²).
template <class T>
struct Grid {
    T* items = nullptr;
    std::uint64_t width = 0, height = 0;
};

struct GridSize {
    std::uint64_t width = 0, height = 0;
};

/// The rows of one block of a chunk that holds several grids.
struct GridRows {
    std::size_t grid = 0;
    std::uint64_t first = 0, count = 0;
};

/// Rows of a block whose items take `codeBytes` as integers: as many as kMaxBlockBytes hold.
inline std::uint64_t rowsPerBlock(std::uint64_t width, std::size_t codeBytes) {
    return std::max<std::uint64_t>(1,
                                   kMaxBlockBytes / codeBytes / std::max<std::uint64_t>(1, width));
}

inline std::uint64_t blockCount(const GridSize& size, std::size_t codeBytes) {
    if (size.width == 0) return 0;
    const std::uint64_t rows = rowsPerBlock(size.width, codeBytes);
    return (size.height + rows - 1) / rows;
}

inline std::vector<GridRows> rowsOfBlocks(std::span<const GridSize> sizes, std::size_t codeBytes) {
    std::vector<GridRows> blocks;
    for (std::size_t g = 0; g < sizes.size(); ++g) {
        const std::uint64_t rows = rowsPerBlock(sizes[g].width, codeBytes);
        for (std::uint64_t i = 0; i < blockCount(sizes[g], codeBytes); ++i)
            blocks.push_back({g, i * rows, std::min(rows, sizes[g].height - i * rows)});
    }
    return blocks;
}

/// What to do with items that have been written or read: nothing, or let go of those in a file.
struct KeepItems {
    void operator()(const void*, std::size_t) const {}
};

template <class T, class A>
auto releaseItems(const std::vector<T, A>& items) {
    if constexpr (requires(const A& a) { a.release(std::size_t{}, items.data(), std::size_t{}); })
        return [&](const T* first, std::size_t count) {
            items.get_allocator().release(items.capacity(), first, count);
        };
    else
        return KeepItems{};
}

template <class Codec, class T, class ToCode, class Done = KeepItems>
void addGrids(ChunkFileWriter& file, const std::string& name, std::span<const Grid<const T>> grids,
              const ToCode& toCode, const Done& done = {}) {
    constexpr std::size_t kCodeBytes = sizeof(typename Codec::Element);
    std::vector<GridSize> sizes;
    for (const Grid<const T>& grid : grids) sizes.push_back({grid.width, grid.height});
    const std::vector<GridRows> blocks = rowsOfBlocks(sizes, kCodeBytes);
    file.add(name, blocks.size(), [&](std::size_t i) {
        const Grid<const T>& grid = grids[blocks[i].grid];
        std::vector<typename Codec::Element> codes(blocks[i].count * grid.width);
        const T* items = grid.items + blocks[i].first * grid.width;
        std::transform(items, items + codes.size(), codes.begin(), toCode);
        done(items, codes.size());
        return Block{Codec::encode(codes, grid.width), codes.size() * kCodeBytes};
    });
}

/// The chunk, after checking that it holds grids of these sizes, which may then be allocated.
template <class Codec>
const Chunk& gridChunk(const ChunkFileReader& file, std::string_view name,
                       std::span<const GridSize> sizes) {
    constexpr std::size_t kCodeBytes = sizeof(typename Codec::Element);
    std::uint64_t blocks = 0, bytes = 0;
    for (const GridSize& size : sizes) {
        blocks += blockCount(size, kCodeBytes);
        bytes += size.width * size.height * kCodeBytes;
    }
    return file.chunk(name, blocks, bytes);
}

/// Fills allocated grids. Precondition: chunk is gridChunk() of their sizes.
template <class Codec, class T, class FromCode, class Done = KeepItems>
void readGrids(const ChunkFileReader& file, const Chunk& chunk, std::span<const Grid<T>> grids,
               const FromCode& fromCode, const Done& done = {}) {
    std::vector<GridSize> sizes;
    for (const Grid<T>& grid : grids) sizes.push_back({grid.width, grid.height});
    const std::vector<GridRows> blocks = rowsOfBlocks(sizes, sizeof(typename Codec::Element));
    file.read(chunk, [&](std::size_t i, std::span<const std::uint8_t> bytes) {
        const Grid<T>& grid = grids[blocks[i].grid];
        std::vector<typename Codec::Element> codes(blocks[i].count * grid.width);
        if (bytes.size() != codes.size() * Codec::kElementBytes)
            throw InputError(file.where(chunk), "a block is not of its grid's size: bake it again");
        Codec::decode(bytes, codes, grid.width);
        T* const items = grid.items + blocks[i].first * grid.width;
        std::transform(codes.begin(), codes.end(), items, fromCode);
        done(items, codes.size());
    });
}

template <class Codec, class T, class A, class ToCode>
void addGrid(ChunkFileWriter& file, const std::string& name, const std::vector<T, A>& items,
             std::uint64_t width, const ToCode& toCode) {
    const Grid<const T> grid{items.data(), width, width == 0 ? 0 : items.size() / width};
    addGrids<Codec, T>(file, name, std::span(&grid, 1), toCode, releaseItems(items));
}

template <class Codec, class T, class A, class FromCode>
void readGrid(const ChunkFileReader& file, std::string_view name, std::vector<T, A>& items,
              const GridSize& size, const FromCode& fromCode) {
    const Chunk& chunk = gridChunk<Codec>(file, name, std::span(&size, 1));
    items.resize(size.width * size.height);
    const Grid<T> grid{items.data(), size.width, size.height};
    readGrids<Codec, T>(file, chunk, std::span(&grid, 1), fromCode, releaseItems(items));
}

/// The codec of structs that consist of 32-bit members alone.
template <class T>
using WordCodec = GridCodec<std::uint32_t, sizeof(T) / 4>;

/// An array of structs that consist of 32-bit members alone, unchanged.
template <class T>
void addArray(ChunkFileWriter& file, const std::string& name, const std::vector<T>& items) {
    using Codec = WordCodec<T>;
    addGrid<Codec>(file, name, items, 1,
                   [](const T& item) { return std::bit_cast<typename Codec::Element>(item); });
}

template <class T>
void readArray(const ChunkFileReader& file, std::string_view name, std::vector<T>& items,
               std::uint64_t count) {
    using Codec = WordCodec<T>;
    readGrid<Codec>(file, name, items, {1, count},
                    [](const typename Codec::Element& code) { return std::bit_cast<T>(code); });
}

}  // namespace vlf
