#pragma once
// The container and the JSON of a glTF file, checked before anything is made of them: tinygltf
// leaves out properties of the wrong type silently and descends into nested values without limit.

#include "vlf/scene/import/import.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vlf {

/// The parts of a file, within its bytes.
struct GltfChunks {
    std::string_view json;
    std::span<const std::uint8_t> binary;  ///< of a GLB file's binary chunk; empty: there is none
};

/// The parts of a .gltf or .glb file, told apart by content. Throws InputError if the chunks of a
/// GLB file do not fit into it or the JSON is nested or larger than any sensible document.
GltfChunks gltfChunks(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// Parses the document. Checks its version, required extensions, the types of the properties that
/// are read, and that every index refers to something; throws InputError with the element.
/// Extensions that are left out are reported.
nlohmann::json parseGltf(const std::string& path, std::string_view text, ImportReport& report);

/// An array of the root or of one of its elements; empty if it is not there.
const nlohmann::json& gltfElements(const nlohmann::json& parent, const char* collection);

}  // namespace vlf
