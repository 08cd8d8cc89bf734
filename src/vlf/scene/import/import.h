#pragma once
// Reading scene files.

#include "vlf/base/file_stamp.h"
#include "vlf/scene/scene.h"

#include <string>
#include <vector>

namespace vlf {

/// What an importer has to say besides the scene: one line each, with file and line or element.
struct ImportReport {
    std::vector<std::string> warnings;
    /// Every file that was read, as it was just before, or looked for in vain because another names
    /// it. After a failure, those up to it.
    std::vector<FileStamp> files;
    std::size_t degenerateTriangles = 0;  ///< dropped: no area
    std::size_t duplicateTriangles = 0;   ///< dropped: repeats of an earlier triangle
};

/// Reads and merges scene files: .obj (with its .mtl), .gltf, .glb. Cameras come from glTF and
/// from `NAME.cameras.json` beside `NAME.obj`.
/// Throws InputError naming file and line or element, FileError if a file cannot be read, and
/// InputError if the merged scene has no triangle.
Scene importScene(const std::vector<std::string>& paths, ImportReport& report);

struct ImportedScene;

/// One file, not yet cleaned, its masks (alpha_mask.h) not yet cut: used by importScene.
ImportedScene importObj(const std::string& path, ImportReport& report);
ImportedScene importGltf(const std::string& path, ImportReport& report);

/// Drops degenerate and repeated triangles, computes missing (zero) normals, scales reflectances
/// that sum to more than one, limits emission, drops unused vertices, replaces texture coordinates
/// that are not finite. Called by importScene on the merged scene.
void cleanScene(Scene& scene, ImportReport& report);

}  // namespace vlf
