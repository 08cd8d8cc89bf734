#pragma once
// Materials of OBJ files.

#include "vlf/scene/import/alpha_mask.h"
#include "vlf/scene/import/mtl_file.h"
#include "vlf/scene/import/obj_file.h"

#include <cstdint>
#include <optional>

namespace vlf {

/// What a name of usemtl stands for in the scene.
struct ObjMaterial {
    std::optional<std::uint32_t> index;  ///< into Scene::materials; nothing: its faces are left out
    Vec2 uvScale{1}, uvOffset{0};        ///< of its textures: uv' = uvScale * uv + uvOffset
};

/// Reads the material libraries of the file and adds the materials that it uses, and their
/// textures, alpha masks and what is glass, to what is imported. The result runs parallel to
/// file.materials; one more at the end stands for faces without usemtl. Unknown materials and
/// missing libraries or textures are reported.
std::vector<ObjMaterial> addObjMaterials(ImportedScene& imported, const ObjFile& file,
                                         ImportReport& report);

}  // namespace vlf
