#include "vlf/unwrap/mesh_adjacency.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <tuple>

namespace vlf {

namespace {

constexpr float kSameNormal = 0.99f;   // cos 8°: one shading normal, split by texture seams
constexpr float kSmoothFold = 0.5f;    // cos 60°: sharper folds are edges even if shaded smooth
constexpr float kSlightFold = 0.951f;  // cos 18°: facets of a curved surface without normals

struct Edge {
    std::uint32_t a, b;  // welded vertices, a < b
    std::uint32_t triangle;
    std::array<std::uint8_t, 2> corner;  // of a and of b

    auto key() const { return std::tie(a, b); }
};

/// Maps every vertex to the first vertex at the same position.
std::vector<std::uint32_t> weldByPosition(const Scene& scene) {
    const auto& positions = scene.positions;
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        const Vec3& p = positions[i];
        return std::make_tuple(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return std::make_tuple(key(i), i) < std::make_tuple(key(j), j);
    });
    std::vector<std::uint32_t> welded(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        welded[order[i]] =
            i > 0 && key(order[i]) == key(order[i - 1]) ? welded[order[i - 1]] : order[i];
    return welded;
}

std::vector<Edge> sortedEdges(const Scene& scene) {
    const std::vector<std::uint32_t> welded = weldByPosition(scene);
    std::vector<Edge> edges;
    edges.reserve(3 * scene.triangles.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (std::uint8_t c = 0; c < 3; ++c) {
            const std::uint8_t d = (c + 1) % 3;
            const std::uint32_t a = welded[scene.triangles[t].vertex[c]];
            const std::uint32_t b = welded[scene.triangles[t].vertex[d]];
            edges.push_back(a < b ? Edge{a, b, t, {c, d}} : Edge{b, a, t, {d, c}});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
        return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
    });
    return edges;
}

bool isSmooth(const Scene& scene, const Edge& x, const Edge& y) {
    const float fold =
        glm::dot(geometricNormal(scene, x.triangle), geometricNormal(scene, y.triangle));
    if (fold > kSlightFold) return true;
    if (fold < kSmoothFold) return false;
    const auto normal = [&](const Edge& e, int end) {
        return scene.normals[scene.triangles[e.triangle].vertex[e.corner[end]]];
    };
    return glm::dot(normal(x, 0), normal(y, 0)) > kSameNormal &&
           glm::dot(normal(x, 1), normal(y, 1)) > kSameNormal;
}

}  // namespace

MeshAdjacency makeAdjacency(const Scene& scene) {
    const std::vector<Edge> edges = sortedEdges(scene);
    struct Link {
        std::uint32_t from;
        EdgeNeighbour to;
    };
    std::vector<Link> links;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].key() == edges[begin].key()) ++end;
        // An edge of more than two triangles is where surfaces cross: nothing goes on across it,
        // except that each pair may still be coplanar.
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t j = i + 1; j < std::min(end, i + 4); ++j) {
                const bool smooth = isSmooth(scene, edges[i], edges[j]);
                links.push_back({edges[i].triangle, {edges[j].triangle, smooth}});
                links.push_back({edges[j].triangle, {edges[i].triangle, smooth}});
            }
    }
    MeshAdjacency adjacency;
    adjacency.first.assign(scene.triangles.size() + 1, 0);
    for (const Link& link : links) ++adjacency.first[link.from + 1];
    std::partial_sum(adjacency.first.begin(), adjacency.first.end(), adjacency.first.begin());
    adjacency.neighbours.resize(links.size());
    std::vector<std::uint32_t> next(adjacency.first.begin(), adjacency.first.end() - 1);
    for (const Link& link : links) adjacency.neighbours[next[link.from]++] = link.to;
    return adjacency;
}

}  // namespace vlf
