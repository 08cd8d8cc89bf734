#include "vlf/render/drawing/mesh_edges.h"

#include "vlf/math/random.h"

#include <bit>
#include <unordered_map>
#include <utility>

namespace vlf {

namespace {

/// Shading normals that differ by more than about 10 degrees make a crease.
constexpr float kSmoothCosine = 0.985f;

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        std::uint64_t h = 0;
        // Adding zero makes -0 and 0, which are equal, hash equally.
        for (int i = 0; i < 3; ++i) h = mixBits(h ^ std::bit_cast<std::uint32_t>(p[i] + 0.0f));
        return h;
    }
};

/// Number of the place of each vertex: equal positions have equal numbers.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& positions) {
    std::unordered_map<Vec3, std::uint32_t, PositionHash> places;
    std::vector<std::uint32_t> place;
    for (const Vec3& p : positions)
        place.push_back(
            places.try_emplace(p, static_cast<std::uint32_t>(places.size())).first->second);
    return place;
}

struct EdgeBuilder {
    MeshEdge edge;
    Vec3 fromShading{0}, toShading{0};  ///< shading normals of the first triangle
    std::uint32_t material = 0;
    int triangles = 0;

    /// A triangle at the edge, and its vertices at the edge's two ends.
    void add(const Scene& scene, std::uint32_t t, std::uint32_t from, std::uint32_t to) {
        edge.otherNormal = geometricNormal(scene, t);
        if (++triangles == 1) {
            edge.normal = edge.otherNormal;
            edge.crease = true;
            material = scene.triangles[t].material;
            fromShading = scene.normals[from];
            toShading = scene.normals[to];
        } else {
            edge.crease = triangles > 2 || scene.triangles[t].material != material ||
                          glm::dot(fromShading, scene.normals[from]) < kSmoothCosine ||
                          glm::dot(toShading, scene.normals[to]) < kSmoothCosine;
        }
    }
};

}  // namespace

std::vector<MeshEdge> meshEdges(const Scene& scene) {
    const std::vector<std::uint32_t> place = weld(scene.positions);
    std::unordered_map<std::uint64_t, std::size_t> known;
    std::vector<EdgeBuilder> builders;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            std::uint32_t from = scene.triangles[t].vertex[corner];
            std::uint32_t to = scene.triangles[t].vertex[(corner + 1) % 3];
            if (place[from] > place[to]) std::swap(from, to);
            const auto [at, added] =
                known.try_emplace(std::uint64_t{place[from]} << 32 | place[to], builders.size());
            if (added) builders.push_back({{scene.positions[from], scene.positions[to]}});
            builders[at->second].add(scene, t, from, to);
        }
    }
    std::vector<MeshEdge> edges;
    for (const EdgeBuilder& b : builders) edges.push_back(b.edge);
    return edges;
}

}  // namespace vlf
