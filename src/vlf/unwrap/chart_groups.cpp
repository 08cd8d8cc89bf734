#include "vlf/unwrap/chart_groups.h"

#include "vlf/math/frame.h"
#include "vlf/unwrap/mesh_adjacency.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace vlf {

namespace {

constexpr float kCone = 0.64f;            // cos 50°: normals of a curved chart about its first
constexpr float kCoplanar = 0.999999f;    // cos 0.08°
constexpr float kPlaneTolerance = 1e-5f;  // of the scene's radius
constexpr std::uint32_t kUnassigned = 0xffffffffu;

/// A set of coplanar, connected triangles of one material.
struct Patch {
    std::vector<std::uint32_t> triangles;
    Vec3 normal;
};

/// Remembers which depths along an axis a group has occupied, texel by texel, so that it never
/// folds over itself.
class Occupancy {
  public:
    Occupancy(const Vec3& axis, float texelSize)
        : frame_(frameFromNormal(axis)), texelSize_(texelSize) {}

    bool fits(const Scene& scene, const Patch& patch) const {
        bool free = true;
        forEachSample(scene, patch, [&](std::uint64_t cell, float depth) {
            const auto it = range_.find(cell);
            if (it != range_.end() && (depth > it->second.x + kOverlap * texelSize_ ||
                                       depth < it->second.y - kOverlap * texelSize_))
                free = false;
        });
        return free;
    }

    void add(const Scene& scene, const Patch& patch) {
        forEachSample(scene, patch, [&](std::uint64_t cell, float depth) {
            const auto [it, isNew] = range_.try_emplace(cell, Vec2(depth));
            it->second = {std::min(it->second.x, depth), std::max(it->second.y, depth)};
        });
    }

  private:
    // Within one texel the surface rises by at most tan 50° texels.
    static constexpr float kOverlap = 2.5f;

    template <class Visit>
    void forEachSample(const Scene& scene, const Patch& patch, Visit visit) const {
        for (const std::uint32_t t : patch.triangles) {
            const Vec3 a = frame_.toLocal(scene.position(t, 0)) / texelSize_;
            const Vec3 ab = frame_.toLocal(scene.position(t, 1)) / texelSize_ - a;
            const Vec3 ac = frame_.toLocal(scene.position(t, 2)) / texelSize_ - a;
            const float longest =
                std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
            const int steps = std::clamp(static_cast<int>(std::ceil(1.5f * longest)), 1, 512);
            for (int i = 0; i <= steps; ++i)
                for (int j = 0; i + j <= steps; ++j) {
                    const Vec3 p = a + (ab * static_cast<float>(i) + ac * static_cast<float>(j)) /
                                           static_cast<float>(steps);
                    visit(cellOf(p), p.z * texelSize_);
                }
        }
    }

    static std::uint64_t cellOf(const Vec3& p) {
        const auto part = [](float v) {
            return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(v)));
        };
        return static_cast<std::uint64_t>(part(p.x)) << 32 | part(p.y);
    }

    Frame frame_;
    float texelSize_;
    std::unordered_map<std::uint64_t, Vec2> range_;
};

class Grouper {
  public:
    Grouper(const Scene& scene, float texelSize, const TexelPieces& pieces)
        : scene_(scene),
          pieces_(pieces),
          texelSize_(texelSize),
          planeTolerance_(kPlaneTolerance * boundingSphere(scene).radius),
          adjacency_(makeAdjacency(scene)) {}

    std::vector<ChartGroup> run() {
        growPatches();
        linkPatches();
        std::vector<ChartGroup> groups;
        assigned_.assign(patches_.size(), false);
        for (std::uint32_t p = 0; p < patches_.size(); ++p)
            if (!assigned_[p]) groups.push_back(growGroup(p));
        return groups;
    }

  private:
    void growPatches() {
        patchOf_.assign(scene_.triangles.size(), kUnassigned);
        for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t)
            if (patchOf_[t] == kUnassigned) patches_.push_back(growPatch(t));
    }

    Patch growPatch(std::uint32_t seed) {
        const auto id = static_cast<std::uint32_t>(patches_.size());
        Patch patch{{seed}, geometricNormal(scene_, seed)};
        patchOf_[seed] = id;
        for (std::size_t i = 0; i < patch.triangles.size(); ++i)
            forNeighbours(patch.triangles[i], [&](const EdgeNeighbour& n) {
                if (patchOf_[n.triangle] != kUnassigned || !belongTogether(seed, n.triangle) ||
                    !coplanar(patch.normal, seed, n.triangle))
                    return;
                patchOf_[n.triangle] = id;
                patch.triangles.push_back(n.triangle);
            });
        return patch;
    }

    bool coplanar(const Vec3& normal, std::uint32_t seed, std::uint32_t t) const {
        if (glm::dot(normal, geometricNormal(scene_, t)) < kCoplanar) return false;
        for (int c = 0; c < 3; ++c)
            if (std::abs(glm::dot(normal, scene_.position(t, c) - scene_.position(seed, 0))) >
                planeTolerance_)
                return false;
        return true;
    }

    /// By material and piece.
    bool belongTogether(std::uint32_t a, std::uint32_t b) const {
        return scene_.triangles[a].material == scene_.triangles[b].material &&
               (pieces_.empty() || pieces_[a].piece == pieces_[b].piece);
    }

    template <class Visit>
    void forNeighbours(std::uint32_t t, Visit visit) const {
        for (std::uint32_t i = adjacency_.first[t]; i < adjacency_.first[t + 1]; ++i)
            visit(adjacency_.neighbours[i]);
    }

    /// Smoothly adjoining patches of the same material.
    void linkPatches() {
        smooth_.resize(patches_.size());
        for (std::uint32_t p = 0; p < patches_.size(); ++p) {
            for (const std::uint32_t t : patches_[p].triangles)
                forNeighbours(t, [&](const EdgeNeighbour& n) {
                    if (n.smooth && patchOf_[n.triangle] != p && belongTogether(t, n.triangle))
                        smooth_[p].push_back(patchOf_[n.triangle]);
                });
            std::sort(smooth_[p].begin(), smooth_[p].end());
            smooth_[p].erase(std::unique(smooth_[p].begin(), smooth_[p].end()), smooth_[p].end());
        }
    }

    ChartGroup growGroup(std::uint32_t seed) {
        std::vector<std::uint32_t> members{seed};
        assigned_[seed] = true;
        if (!smooth_[seed].empty()) {
            const Vec3 axis = patches_[seed].normal;
            Occupancy occupancy(axis, texelSize_);
            occupancy.add(scene_, patches_[seed]);
            for (std::size_t i = 0; i < members.size(); ++i)
                for (const std::uint32_t p : smooth_[members[i]]) {
                    if (assigned_[p] || glm::dot(axis, patches_[p].normal) < kCone ||
                        !occupancy.fits(scene_, patches_[p]))
                        continue;
                    occupancy.add(scene_, patches_[p]);
                    assigned_[p] = true;
                    members.push_back(p);
                }
        }
        return makeGroup(members);
    }

    ChartGroup makeGroup(const std::vector<std::uint32_t>& members) const {
        ChartGroup group;
        Vec3 sum(0);
        for (const std::uint32_t p : members)
            for (const std::uint32_t t : patches_[p].triangles) {
                group.triangles.push_back(t);
                sum += areaVector(scene_, t);
            }
        std::sort(group.triangles.begin(), group.triangles.end());
        group.planar = members.size() == 1;
        group.axis = group.planar ? patches_[members[0]].normal : glm::normalize(sum);
        return group;
    }

    const Scene& scene_;
    const TexelPieces& pieces_;
    float texelSize_, planeTolerance_;
    MeshAdjacency adjacency_;
    std::vector<Patch> patches_;
    std::vector<std::uint32_t> patchOf_;              // per triangle
    std::vector<std::vector<std::uint32_t>> smooth_;  // per patch
    std::vector<bool> assigned_;                      // per patch
};

}  // namespace

std::vector<ChartGroup> groupTriangles(const Scene& scene, float texelSize,
                                       const TexelPieces& pieces) {
    return Grouper(scene, texelSize, pieces).run();
}

std::vector<std::uint32_t> groupOfTriangles(const std::vector<ChartGroup>& groups,
                                            std::size_t triangles) {
    std::vector<std::uint32_t> groupOf(triangles);
    for (std::uint32_t g = 0; g < groups.size(); ++g)
        for (const std::uint32_t t : groups[g].triangles) groupOf[t] = g;
    return groupOf;
}

}  // namespace vlf
