// Most of a field file lies behind checksums: three of four mutations are made to the content of a
// chunk, and the file is sealed again.

#include "fuzz/open_field_file.h"
#include "fuzz/readers.h"

#include "vlf/base/error.h"
#include "vlf/math/random.h"

#include <algorithm>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace vlf::fuzz {

namespace {

using Chunks = std::vector<OpenChunk>;

std::size_t below(RandomStream& random, std::size_t n) {
    return random.nextBits() % n;
}

/// Room for a mutation to grow into.
void mutate(Blob& bytes) {
    const std::size_t size = bytes.size();
    bytes.resize(std::min(size + 64, kMaxBlockBytes));
    bytes.resize(LLVMFuzzerMutate(bytes.data(), size, bytes.size()));
}

void mutateBlock(Chunks& chunks, RandomStream& random) {
    OpenChunk& chunk = chunks[below(random, chunks.size())];
    if (chunk.blocks.empty()) {
        chunk.blocks.emplace_back();
        return;
    }
    Block& block = chunk.blocks[below(random, chunk.blocks.size())];
    if (below(random, 8) == 0)
        block.memoryBytes = below(random, kMaxBlockBytes + 1);
    else
        mutate(block.bytes);
}

void mutateOrder(Chunks& chunks, RandomStream& random) {
    const std::size_t a = below(random, chunks.size()), b = below(random, chunks.size());
    switch (below(random, 4)) {
        case 0:
            std::swap(chunks[a].name, chunks[b].name);
            break;
        case 1:
            std::swap(chunks[a], chunks[b]);
            break;
        case 2:
            chunks[a].blocks.insert(chunks[a].blocks.end(), chunks[b].blocks.begin(),
                                    chunks[b].blocks.end());
            break;
        default:
            chunks.erase(chunks.begin() + static_cast<std::ptrdiff_t>(a));
            break;
    }
}

Blob resealed(Bytes bytes, RandomStream& random) {
    Chunks chunks = openFieldFile(bytes);
    if (chunks.empty()) return {};
    if (below(random, 8) == 0)
        mutateOrder(chunks, random);
    else
        mutateBlock(chunks, random);
    return sealFieldFile(chunks);
}

std::size_t mutateFile(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    RandomStream random(seed, 0);
    if (below(random, 4) == 0) return LLVMFuzzerMutate(data, size, most);
    try {
        const Blob file = resealed({data, size}, random);
        if (file.empty() || file.size() > most) return LLVMFuzzerMutate(data, size, most);
        std::copy(file.begin(), file.end(), data);
        return file.size();
    } catch (const Error&) {
        return LLVMFuzzerMutate(data, size, most);
    }
}

}  // namespace

}  // namespace vlf::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    return vlf::fuzz::mutateFile(data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    vlf::fuzz::readFieldFile({data, size});
    return 0;
}
