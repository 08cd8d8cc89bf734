#pragma once
// Vertex colours, and emission textures with coordinates of their own, as the scene has neither.

#include "vlf/scene/import/gltf_primitive.h"

#include <cstdint>
#include <map>
#include <vector>

namespace vlf {

/// Brings the colours and emission coordinates of primitives into textures, in which their
/// triangles lie side by side in blocks: as fine as the textures they are made of, within limits,
/// and exact (all but 4 % of the contrast within a triangle) for colours alone.
class GltfPainter {
  public:
    /// Textures and materials are added to the scene, which must outlive the painter.
    explicit GltfPainter(Scene& scene) : scene_(scene) {}

    /// The material to use in place of `material`: itself if the primitive has neither colours nor
    /// emission coordinates, or a copy; texture coordinates become those of the copy's textures.
    /// `source` identifies the primitive in the document: another instance gets the same material.
    std::uint32_t paint(GltfPrimitive& primitive, std::uint32_t material,
                        const tinygltf::Primitive& source);

  private:
    struct Painted {
        std::uint32_t material;
        std::vector<Vec2> uvs;  ///< per corner; empty: as they were
    };

    Painted make(const GltfPrimitive& primitive, std::uint32_t material);

    Scene& scene_;
    std::map<const tinygltf::Primitive*, Painted> painted_;
};

}  // namespace vlf
