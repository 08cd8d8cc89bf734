#pragma once
// The triangles of glTF primitives, in the pose of the file.

#include "vlf/scene/import/gltf_file.h"
#include "vlf/scene/import/gltf_material.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vlf {

/// Vertices and triangles. Texture coordinates with v up.
struct GltfPrimitive {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;      ///< empty: none are given, its triangles are flat
    std::vector<Vec2> uvs;          ///< zeros where the mesh has none
    std::vector<Vec2> emissionUvs;  ///< of the emission texture; empty: as uvs
    std::vector<Vec2> maskUvs;      ///< of the alpha mask; empty: as uvs
    std::vector<Vec3> colors;       ///< factors of the reflectance, in [0, 1]; empty: white
    std::vector<std::uint32_t> corners;

    /// Gives every corner a vertex of its own.
    void unshare();
};

/// Reads a primitive of triangles, strips or fans in the space of its mesh. `weights` are those of
/// its morph targets; missing ones are 0. Throws InputError naming `element` and the attribute that
/// cannot be used.
GltfPrimitive readPrimitive(const GltfFile& file, const tinygltf::Primitive& source,
                            std::span<const double> weights, const GltfMaterial& material,
                            const std::string& element);

/// Moves the vertices into the world: all by one matrix, or each by its own. The front stays the
/// front under reflections, which turn the winding round. Throws InputError if a position is not
/// finite then.
void place(GltfPrimitive& primitive, std::span<const glm::dmat4> worldFromVertex,
           const SourceLocation& where);

}  // namespace vlf
