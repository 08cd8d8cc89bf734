#pragma once
// Camera paths as files, docs/camera-path.md.

#include "vlf/display/camera_path.h"

#include <string>
#include <string_view>

namespace vlf {

/// The path in the text of a file. Throws InputError that names `nameForErrors`, the element, and
/// what is wrong with it.
CameraPath parseCameraPath(std::string_view text, const std::string& nameForErrors);

/// The text of a file; parsing it gives an equal path.
std::string toText(const CameraPath& path);

/// Throws InputError as parseCameraPath, and FileError.
CameraPath readCameraPath(const std::string& file);

/// Throws FileError; what was there before is then left.
void writeCameraPath(const std::string& file, const CameraPath& path);

}  // namespace vlf
