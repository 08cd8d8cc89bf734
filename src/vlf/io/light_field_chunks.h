#pragma once
// The light field's part of a field file.

#include "vlf/io/chunk_file.h"
#include "vlf/io/field_file.h"

namespace vlf {

void addLightField(ChunkFileWriter& file, const LightField& field);

/// The light field of a file that announces these counts; `frame` is not part of it. The layout
/// of the radiance field is checked; indices and numbers of the rest are not yet.
LightField readLightField(const ChunkFileReader& file, const FieldCounts& counts);

}  // namespace vlf
