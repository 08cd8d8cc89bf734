#pragma once
// Skins of glTF meshes, in the pose of the file.

#include "vlf/scene/import/gltf_file.h"

#include <glm/mat4x4.hpp>

#include <optional>
#include <string>
#include <vector>

namespace vlf {

/// worldFromNode of every node of the document; nothing for those outside of the scene.
using GltfPose = std::vector<std::optional<glm::dmat4>>;

/// Where the skin of a node's mesh puts the vertices of a primitive: a matrix into the world per
/// vertex, the mean of its joints' by weight (linear blend skinning; the node's own place counts
/// for nothing). Vertices without weights follow the node. Throws InputError naming skin or
/// `element` if a joint is missing from it or from the scene. Precondition: the primitive has
/// JOINTS_0.
std::vector<glm::dmat4> worldFromSkinnedVertices(const GltfFile& file, int node,
                                                 const tinygltf::Primitive& primitive,
                                                 const GltfPose& pose, const std::string& element);

}  // namespace vlf
