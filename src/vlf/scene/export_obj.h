#pragma once
// Scenes to Wavefront OBJ.

#include "vlf/scene/scene.h"

#include <string>

namespace vlf {

/// Writes NAME.obj, NAME.mtl, NAME.cameras.json (where there are cameras) and the textures
/// NAME-TEXTURE.png (.exr where they are high dynamic range) into `folder`, which is made if it
/// does not exist. `name` is a file name without extension. importScene reads back the same
/// scene; numbers are written so that every float is kept. Each file replaces an older one only
/// when complete, the .obj last.
/// Throws InputError, before anything is written, if the scene has what OBJ cannot hold: a
/// material that emits on both sides, a texture that wraps in different ways along u and v or by
/// mirroring; FileError if a file cannot be written.
void exportObj(const Scene& scene, const std::string& folder, const std::string& name);

}  // namespace vlf
