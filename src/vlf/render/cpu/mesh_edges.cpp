#include "vlf/render/cpu/mesh_edges.h"

#include "vlf/math/random.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace vlf {

namespace {

constexpr float kCreaseCosine = 0.866f;

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
    std::uint32_t material = 0;
    int triangles = 0;

    void add(const Vec3& normal, std::uint32_t triangleMaterial) {
        if (++triangles == 1) {
            material = triangleMaterial;
            edge.normal = edge.otherNormal = normal;
            edge.crease = true;
        } else {
            edge.otherNormal = normal;
            edge.crease = triangles > 2 || triangleMaterial != material ||
                          glm::dot(edge.normal, normal) < kCreaseCosine;
        }
    }
};

}  // namespace

std::vector<MeshEdge> meshEdges(const Scene& scene) {
    const std::vector<std::uint32_t> place = weld(scene.positions);
    std::unordered_map<std::uint64_t, std::size_t> known;
    std::vector<EdgeBuilder> builders;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const Vec3 normal = geometricNormal(scene, t);
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t a = scene.triangles[t].vertex[corner];
            const std::uint32_t b = scene.triangles[t].vertex[(corner + 1) % 3];
            const auto [low, high] = std::minmax({place[a], place[b]});
            const auto [at, added] =
                known.try_emplace(std::uint64_t{low} << 32 | high, builders.size());
            if (added) builders.push_back({{scene.positions[a], scene.positions[b]}});
            builders[at->second].add(normal, scene.triangles[t].material);
        }
    }
    std::vector<MeshEdge> edges;
    for (const EdgeBuilder& b : builders) edges.push_back(b.edge);
    return edges;
}

}  // namespace vlf
