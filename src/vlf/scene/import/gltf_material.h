#pragma once
// Materials of glTF files.

#include "vlf/scene/import/alpha_mask.h"
#include "vlf/scene/import/gltf_file.h"

#include <cstdint>
#include <optional>

namespace vlf {

/// Which texture coordinates a texture reads: uv' = offset + scaleRotate * uv, in the
/// coordinates of glTF (v down).
struct GltfUvMapping {
    int set = 0;  ///< n of TEXCOORD_n
    glm::mat2 scaleRotate{1};
    Vec2 offset{0};

    bool operator==(const GltfUvMapping&) const = default;
};

/// What a material of the file stands for in the scene.
struct GltfMaterial {
    std::optional<std::uint32_t>
        index;         ///< into Scene::materials; nothing: its surfaces are left out
    GltfUvMapping uv;  ///< of its textures
    std::optional<GltfUvMapping> emissionUv;  ///< of the emission texture, if it has another
};

/// Adds the materials of the file and their textures to the scene, and their alpha masks to
/// `masked`. The result runs parallel to the
/// file's materials. Images that are missing or cannot be decoded are reported.
std::vector<GltfMaterial> addGltfMaterials(Scene& scene, MaskedMaterials& masked,
                                           const GltfFile& file, ImportReport& report);

}  // namespace vlf
