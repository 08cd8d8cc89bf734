#pragma once
// Cameras of scene files that cannot hold them.

#include "vlf/scene/import/import.h"

#include <string>
#include <vector>

namespace vlf {

/// Reads `NAME.cameras.json` beside `NAME.obj`:
///   {"cameras": [{"name": "front", "eye": [x, y, z], "look": [x, y, z],
///                 "up": [0, 1, 0], "verticalFov": 50}]}
/// in metres and degrees; up and verticalFov may be left out. No such file: no cameras. Throws
/// InputError that names the file and the element that is wrong.
std::vector<Camera> readCameraSidecar(const std::string& scenePath, ImportReport& report);

}  // namespace vlf
