#pragma once
// The container and the JSON of a glTF file, looked through before tinygltf reads them: it
// descends into nested values without limit, leaves out properties of the wrong type silently
// and fails on compressed files and missing data without saying why or where.

#include "vlf/scene/import/import.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vlf {

/// True if the bytes begin like those of a GLB file.
bool isGlb(const std::vector<std::uint8_t>& bytes);

/// The parts of a file, within its bytes.
struct GltfChunks {
    std::string_view json;
    std::size_t binaryBytes = 0;  ///< of a GLB file's binary chunk; 0: there is none
};

/// Throws InputError if the chunks of a GLB file do not fit into it or the JSON is nested or larger
/// than any sensible document.
GltfChunks gltfChunks(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// Checks syntax, version, required extensions, buffers, and the types of the properties that
/// geometry depends on; throws InputError. Extensions that are left out are reported. Returns
/// advice for the case that reading fails because of a compression that is not marked as required;
/// may be empty.
std::string checkGltfJson(const std::string& path, const GltfChunks& chunks, ImportReport& report);

}  // namespace vlf
