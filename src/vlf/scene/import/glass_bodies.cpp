#include "vlf/scene/import/glass_bodies.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace vlf {

namespace {

/// Of more solids it is not asked which lies in which: the time grows with the square.
constexpr std::size_t kMostNested = 2000;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

struct EdgeHash {
    std::size_t operator()(const Edge& e) const {
        const std::uint64_t h =
            (static_cast<std::uint64_t>(e.first) << 32 | e.second) * 0x9e3779b97f4a7c15ull;
        return static_cast<std::size_t>(h ^ (h >> 31));
    }
};

/// The glass triangles of a scene with their vertices welded.
struct GlassMesh {
    std::vector<std::uint32_t> triangles;                ///< of the scene
    std::vector<std::array<std::uint32_t, 3>> vertices;  ///< theirs
    std::vector<char> counts;                            ///< has an area and is no repeat
    std::unordered_map<Edge, std::vector<std::uint32_t>, EdgeHash> atEdge;  ///< entries of those
};

Edge edgeOf(const std::array<std::uint32_t, 3>& v, int k) {
    const std::uint32_t a = v[k], b = v[(k + 1) % 3];
    return {std::min(a, b), std::max(a, b)};
}

GlassMesh glassMesh(const Scene& scene, const std::vector<char>& isMaterial) {
    GlassMesh mesh;
    std::map<std::array<float, 3>, std::uint32_t> first;
    std::set<std::array<std::uint32_t, 3>> seen;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        if (!isMaterial[scene.triangles[t].material]) continue;
        std::array<std::uint32_t, 3> v;
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = scene.position(t, k) + Vec3(0.0f);
            v[k] = first.try_emplace({p.x, p.y, p.z}, scene.triangles[t].vertex[k]).first->second;
        }
        auto sorted = v;
        std::sort(sorted.begin(), sorted.end());
        const bool counts =
            sorted[0] != sorted[1] && sorted[1] != sorted[2] && seen.insert(sorted).second;
        const auto entry = static_cast<std::uint32_t>(mesh.triangles.size());
        mesh.triangles.push_back(t);
        mesh.vertices.push_back(v);
        mesh.counts.push_back(counts);
        for (int k = 0; k < 3 && counts; ++k) mesh.atEdge[edgeOf(v, k)].push_back(entry);
    }
    return mesh;
}

/// A connected piece.
struct Piece {
    std::vector<std::uint32_t> entries;
    std::vector<char> turned;  ///< whether an entry is wound against the first
    bool closed = true;
};

bool runsAlong(const std::array<std::uint32_t, 3>& v, const Edge& edge) {
    for (int k = 0; k < 3; ++k)
        if (v[k] == edge.first && v[(k + 1) % 3] == edge.second) return true;
    return false;
}

/// The piece of entry `first`, spread over edges.
Piece pieceOf(const GlassMesh& mesh, std::uint32_t first, std::vector<char>& visited) {
    Piece piece;
    const auto add = [&](std::uint32_t entry, bool turned) {
        if (std::exchange(visited[entry], 1)) return;
        piece.entries.push_back(entry);
        piece.turned.push_back(turned);
    };
    add(first, false);
    for (std::size_t i = 0; i < piece.entries.size(); ++i) {
        const std::uint32_t entry = piece.entries[i];
        const bool turned = piece.turned[i] != 0;
        for (int k = 0; k < 3; ++k) {
            const Edge edge = edgeOf(mesh.vertices[entry], k);
            const auto& there = mesh.atEdge.at(edge);
            piece.closed = piece.closed && there.size() == 2;
            const bool along = runsAlong(mesh.vertices[entry], edge);
            for (const std::uint32_t next : there)
                add(next, turned != (runsAlong(mesh.vertices[next], edge) == along));
        }
    }
    return piece;
}

class Solid {
  public:
    Solid(const Scene& scene, const GlassMesh& mesh, const Piece& piece)
        : scene_(scene), mesh_(mesh), piece_(piece) {
        const glm::dvec3 origin = corner(0, 0);
        for (std::size_t i = 0; i < piece.entries.size(); ++i) {
            const glm::dvec3 a = corner(i, 0) - origin, b = corner(i, 1) - origin,
                             c = corner(i, 2) - origin;
            volume_ += (piece.turned[i] ? -1 : 1) * glm::dot(a, glm::cross(b, c));
            for (int k = 0; k < 3; ++k) bounds_.add(Vec3(corner(i, k)));
        }
    }

    double volume() const { return volume_; }
    glm::dvec3 point() const { return corner(0, 0); }

    /// By the number of triangles that a ray from p meets.
    bool contains(const glm::dvec3& p) const {
        if (glm::any(glm::lessThan(Vec3(p), bounds_.lower)) ||
            glm::any(glm::greaterThan(Vec3(p), bounds_.upper)))
            return false;
        const glm::dvec3 direction(0.5377, 0.6931, 0.4801);
        bool inside = false;
        for (std::size_t i = 0; i < piece_.entries.size(); ++i) {
            const glm::dvec3 a = corner(i, 0), e1 = corner(i, 1) - a, e2 = corner(i, 2) - a;
            const glm::dvec3 h = glm::cross(direction, e2), s = p - a;
            const double det = glm::dot(e1, h);
            if (det == 0) continue;
            const double u = glm::dot(s, h) / det;
            const glm::dvec3 q = glm::cross(s, e1);
            const double v = glm::dot(direction, q) / det;
            if (u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / det > 0) inside = !inside;
        }
        return inside;
    }

  private:
    glm::dvec3 corner(std::size_t i, int k) const {
        return scene_.position(mesh_.triangles[piece_.entries[i]], k);
    }

    const Scene& scene_;
    const GlassMesh& mesh_;
    const Piece& piece_;
    double volume_ = 0;  ///< six times, signed, by the winding of the first entry
    Bounds bounds_;
};

bool liesInAnother(const std::vector<Solid>& solids, std::size_t own) {
    bool inside = false;
    for (std::size_t i = 0; i < solids.size(); ++i)
        if (i != own && solids[i].contains(solids[own].point())) inside = !inside;
    return inside;
}

void turn(Triangle& triangle) {
    std::swap(triangle.vertex[1], triangle.vertex[2]);
}

/// Winds the triangles of solids alike, and outwards.
void windOutwards(Scene& scene, const GlassMesh& mesh, const std::vector<Piece>& pieces) {
    std::vector<Solid> solids;
    for (const Piece& piece : pieces) solids.emplace_back(scene, mesh, piece);
    std::vector<char> inwards;
    for (std::size_t i = 0; i < solids.size(); ++i)
        inwards.push_back(solids.size() <= kMostNested && solids[i].volume() < 0 &&
                          !liesInAnother(solids, i));
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t k = 0; k < pieces[i].entries.size(); ++k)
            if ((pieces[i].turned[k] != 0) != (inwards[i] != 0))
                turn(scene.triangles[mesh.triangles[pieces[i].entries[k]]]);
}

/// Gives the triangles of solids their material: its own, or a copy if panes have that.
void assignMaterials(Scene& scene, const GlassMesh& mesh, const std::vector<Piece>& solids) {
    std::vector<char> isSolid(scene.triangles.size(), 0);
    for (const Piece& piece : solids)
        for (const std::uint32_t entry : piece.entries) isSolid[mesh.triangles[entry]] = 1;
    std::set<std::uint32_t> ofPanes;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (mesh.counts[i] && !isSolid[mesh.triangles[i]])
            ofPanes.insert(scene.triangles[mesh.triangles[i]].material);
    std::map<std::uint32_t, std::uint32_t> solidOf;
    for (const std::uint32_t t : mesh.triangles) {
        if (!isSolid[t]) continue;
        const std::uint32_t material = scene.triangles[t].material;
        auto known = solidOf.find(material);
        if (known == solidOf.end()) {
            Material solid = scene.materials[material];
            solid.thin = false;
            solid.transmission = glm::sqrt(solid.transmission);  // once for each of two surfaces
            const bool shared = ofPanes.contains(material);
            if (shared) scene.materials.push_back(solid);
            const auto index =
                shared ? static_cast<std::uint32_t>(scene.materials.size()) - 1 : material;
            scene.materials[index] = solid;
            known = solidOf.emplace(material, index).first;
        }
        scene.triangles[t].material = known->second;
    }
}

}  // namespace

void sortGlass(Scene& scene, std::span<const std::uint32_t> materials) {
    if (materials.empty()) return;
    std::vector<char> isMaterial(scene.materials.size(), 0);
    for (const std::uint32_t m : materials) isMaterial[m] = 1;
    const GlassMesh mesh = glassMesh(scene, isMaterial);
    std::vector<char> visited(mesh.triangles.size(), 0);
    std::vector<Piece> solids;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (visited[i] || !mesh.counts[i]) continue;
        Piece piece = pieceOf(mesh, i, visited);
        if (piece.closed) solids.push_back(std::move(piece));
    }
    windOutwards(scene, mesh, solids);
    assignMaterials(scene, mesh, solids);
}

}  // namespace vlf
