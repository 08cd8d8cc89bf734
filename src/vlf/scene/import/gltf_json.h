#pragma once
// The container and the JSON of a glTF file, looked through before tinygltf reads them: it
// descends into nested values without limit, leaves out properties of the wrong type silently
// and fails on compressed files without saying why.

#include "vlf/scene/import/import.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vlf {

/// True if the bytes begin like those of a GLB file.
bool isGlb(const std::vector<std::uint8_t>& bytes);

/// The JSON text of a .gltf or .glb file. Throws InputError if the chunks of a GLB file do not fit
/// into it or the text is nested or larger than any sensible document.
std::string_view gltfJson(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// Checks syntax, version, required extensions and the types of the properties that geometry
/// depends on; throws InputError. Extensions that are left out are reported. Returns advice for
/// the case that reading fails because of a compression that is not marked as required; may be
/// empty.
std::string checkGltfJson(const std::string& path, std::string_view text, ImportReport& report);

}  // namespace vlf
