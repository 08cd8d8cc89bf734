#pragma once
// A field file taken apart, so that its content can be damaged behind its checksums.

#include "fuzz/readers.h"

#include "vlf/io/chunk_file.h"

#include <string>
#include <vector>

namespace vlf::fuzz {

struct OpenChunk {
    std::string name;  ///< of 1 to 16 characters
    bool critical = true;
    std::vector<Block> blocks;  ///< decompressed; of at most kMaxBlockBytes each
};

/// Throws an Error if the file is damaged.
std::vector<OpenChunk> openFieldFile(Bytes bytes);

/// A file of these chunks with right checksums.
Blob sealFieldFile(const std::vector<OpenChunk>& chunks);

}  // namespace vlf::fuzz
