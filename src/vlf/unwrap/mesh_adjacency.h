#pragma once
// Neighbours of triangles across edges, with vertices identified by position.

#include "vlf/scene/scene.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Two triangles that share an edge. `smooth`: shading goes on across it, either because their
/// vertex normals agree there or because the fold is slight.
struct EdgeNeighbour {
    std::uint32_t triangle = 0;
    bool smooth = false;
};

/// Neighbours of every triangle; of triangle t: neighbours[first[t]] .. neighbours[first[t + 1]].
struct MeshAdjacency {
    std::vector<std::uint32_t> first;
    std::vector<EdgeNeighbour> neighbours;
};

MeshAdjacency makeAdjacency(const Scene& scene);

}  // namespace vlf
