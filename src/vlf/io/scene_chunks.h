#pragma once
// The scene's part of a field file.

#include "vlf/io/chunk_file.h"
#include "vlf/io/field_file.h"

namespace vlf {

EnvironmentInfo infoOf(const Environment& environment);

/// Of a file; none, and black, if it has none.
std::vector<PunctualLight> readLights(const ChunkFileReader& file);
EnvironmentInfo readEnvironmentInfo(const ChunkFileReader& file);

void addScene(ChunkFileWriter& file, const Scene& scene);

/// The scene of a file that announces these counts. Its indices are not yet checked.
Scene readScene(const ChunkFileReader& file, const FieldCounts& counts);

}  // namespace vlf
