#include "vlf/dynamic/subdivide.h"

#include <algorithm>
#include <map>
#include <utility>

namespace vlf {

namespace {

/// The vertices in the middle of edges, each made once.
class Middles {
  public:
    explicit Middles(Scene& scene) : scene_(scene) {}

    std::uint32_t of(std::uint32_t a, std::uint32_t b) {
        const auto next = static_cast<std::uint32_t>(scene_.positions.size());
        const auto [place, isNew] = made_.try_emplace(std::minmax(a, b), next);
        if (isNew) {
            const Vec3 normal = scene_.normals[a] + scene_.normals[b];
            const float length = glm::length(normal);
            scene_.positions.push_back(0.5f * (scene_.positions[a] + scene_.positions[b]));
            scene_.normals.push_back(length > 1e-6f ? normal / length : scene_.normals[a]);
            scene_.uvs.push_back(0.5f * (scene_.uvs[a] + scene_.uvs[b]));
        }
        return place->second;
    }

  private:
    Scene& scene_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made_;
};

}  // namespace

Scene subdivide(const Scene& scene) {
    Scene finer = scene;
    finer.triangles.clear();
    finer.triangles.reserve(4 * scene.triangles.size());
    Middles middles(finer);
    for (const Triangle& t : scene.triangles) {
        const auto [a, b, c] = t.vertex;
        const std::uint32_t ab = middles.of(a, b), bc = middles.of(b, c), ca = middles.of(c, a);
        for (const std::array<std::uint32_t, 3>& corners :
             {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c},
              std::array{ab, bc, ca}})
            finer.triangles.push_back({corners, t.material});
    }
    for (Mesh& mesh : finer.meshes) mesh.firstTriangle *= 4, mesh.triangleCount *= 4;
    return finer;
}

}  // namespace vlf
