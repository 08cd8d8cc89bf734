#pragma once
// What the URIs of a glTF document stand for: its buffers, and the files of its images.

#include "vlf/base/error.h"
#include "vlf/scene/import/import.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vlf {

using GltfBytes = std::vector<std::uint8_t>;

/// The bytes of a data URI in base64; nothing if it is none. Throws InputError if they are damaged.
std::optional<GltfBytes> dataUriBytes(const std::string& uri, const SourceLocation& where);

/// The path of the file that a URI means, seen from the document; it need not exist.
std::string pathOfUri(const std::string& document, const std::string& uri);

/// The buffers of the document, each as long as it says. `binary`: the binary chunk of a GLB file.
/// A buffer that only stands in for data compressed by EXT_meshopt_compression may have none and is
/// empty then. Throws InputError naming the buffer that is missing or too short.
std::vector<GltfBytes> readGltfBuffers(const std::string& document, const nlohmann::json& root,
                                       std::span<const std::uint8_t> binary, ImportReport& report);

}  // namespace vlf
