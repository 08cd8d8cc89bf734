#pragma once
// Geometry of glTF files that is compressed by EXT_meshopt_compression. Draco's is not decoded:
// Debian's library of it brings along versions of tinygltf and stb that would replace ours.

#include "vlf/scene/import/gltf_data.h"

namespace vlf {

/// Makes the document one that is not compressed: buffer views that are get plain bytes in new
/// buffers at the end of `buffers`. Throws InputError naming the buffer view whose data are
/// damaged, or the primitive that exists compressed by Draco alone.
void decompressGltf(const std::string& path, nlohmann::json& root, std::vector<GltfBytes>& buffers);

}  // namespace vlf
