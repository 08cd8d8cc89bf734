#pragma once
// Camera paths as files, docs/camera-path.md.

#include "vlf/display/camera_path.h"
#include "vlf/dynamic/scenario.h"

#include <string>
#include <string_view>
#include <vector>

namespace vlf {

/// A camera's way, and the objects that were in the room and how they moved.
struct Walk {
    CameraPath camera;
    Scenario objects;
};

/// The walk in the text of a file, its objects without their models; files they name are relative
/// to the folder of `name`. Throws InputError that names file and element and what is wrong with
/// it.
Walk parseWalk(std::string_view text, const std::string& name);
CameraPath parseCameraPath(std::string_view text, const std::string& name);

/// The text of a file at `name`; parsing it gives an equal path.
std::string toText(const Walk& walk, const std::string& name);

/// With the models of its objects. What importers remark is added to `warnings`. Throws InputError
/// as parseWalk and for objects whose file cannot be used, and FileError.
Walk readWalk(const std::string& file, ModelLibrary& library, std::vector<std::string>& warnings);

/// The camera alone.
CameraPath readCameraPath(const std::string& file);

/// Throws FileError; what was there before is then left.
void writeWalk(const std::string& file, const Walk& walk);
void writeCameraPath(const std::string& file, const CameraPath& path);

}  // namespace vlf
