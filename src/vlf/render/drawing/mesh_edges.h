#pragma once
// The edges of a scene's triangles, each once, for drawing them as lines.

#include "vlf/scene/scene.h"

#include <vector>

namespace vlf {

/// An edge between two places. Vertices in the same place count as one.
struct MeshEdge {
    Vec3 from{0}, to{0};
    Vec3 normal{0}, otherNormal{0};  ///< unit, of the first two triangles at the edge
    bool crease = false;  ///< a border, a change of material, a bend that is not shaded as smooth,
                          ///< or where more than two triangles meet

    /// Whether the surface turns away from the eye here.
    bool isContour(const Vec3& eye) const {
        return glm::dot(normal, eye - from) * glm::dot(otherNormal, eye - from) < 0;
    }
};

/// In the order of the triangles.
std::vector<MeshEdge> meshEdges(const Scene& scene);

}  // namespace vlf
