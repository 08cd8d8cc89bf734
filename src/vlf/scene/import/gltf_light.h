#pragma once
// Lights of KHR_lights_punctual.

#include "vlf/scene/import/import.h"
#include "vlf/scene/punctual_light.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vlf {

/// The lights of a document, at the origin and shining along -Z, and which of them each node holds.
struct GltfLights {
    std::vector<PunctualLight> lights;
    std::vector<int> ofNode;  ///< -1: none
};

/// Reads them; the photometric intensities of the extension (candela, lux) are taken for W·sr⁻¹ and
/// W·m⁻². Throws InputError, naming the element, for one of no or another type, for a colour,
/// intensity or cone that is none, and for a node that refers to a light that does not exist. That
/// their range is left out is reported.
GltfLights readGltfLights(const std::string& path, const nlohmann::json& root,
                          ImportReport& report);

}  // namespace vlf
