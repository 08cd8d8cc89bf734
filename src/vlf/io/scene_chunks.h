#pragma once
// The scene's part of a field file.

#include "vlf/io/chunk_file.h"
#include "vlf/io/field_file.h"

namespace vlf {

void addScene(ChunkFileWriter& file, const Scene& scene);

/// The scene of a file that announces these counts. Its indices are not yet checked.
Scene readScene(const ChunkFileReader& file, const FieldCounts& counts);

}  // namespace vlf
