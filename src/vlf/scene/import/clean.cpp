#include "vlf/scene/import/import.h"
#include "vlf/scene/import/material_rules.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <unordered_map>

namespace vlf {

namespace {

/// A triangle whose height is below this fraction of the scene's diagonal has no area: half the
/// rounding error of its coordinates.
constexpr double kRelativeHeight = 0x1p-25;

/// Triangles are dropped by giving them this material.
constexpr std::uint32_t kDropped = std::numeric_limits<std::uint32_t>::max();

bool isDegenerate(const Scene& scene, std::uint32_t triangle, double minHeight) {
    const glm::dvec3 a = scene.position(triangle, 0), b = scene.position(triangle, 1),
                     c = scene.position(triangle, 2);
    const double base = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    const double twiceArea = glm::length(glm::cross(b - a, c - a));
    // The normal must be computable in single precision, too.
    const Vec3 n = areaVector(scene, triangle);
    const float squared = glm::dot(n, n);
    return !(twiceArea > minHeight * base) || !(squared >= std::numeric_limits<float>::min());
}

void dropDegenerate(Scene& scene, ImportReport& report) {
    const double minHeight = kRelativeHeight * glm::length(glm::dvec3(boundsOf(scene).size()));
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        if (!isDegenerate(scene, t, minHeight)) continue;
        scene.triangles[t].material = kDropped;
        ++report.degenerateTriangles;
    }
}

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        std::uint64_t h = 0;
        for (int i = 0; i < 3; ++i)  // + 0.0f: -0 and 0 are one position
            h = (h ^ std::bit_cast<std::uint32_t>(p[i] + 0.0f)) * 0x9e3779b97f4a7c15ull;
        return static_cast<std::size_t>(h ^ (h >> 32));
    }
};

/// For every vertex the first vertex at the same position.
std::vector<std::uint32_t> weldedVertices(const Scene& scene) {
    std::unordered_map<Vec3, std::uint32_t, PositionHash> first;
    first.reserve(scene.positions.size());
    std::vector<std::uint32_t> welded(scene.positions.size());
    for (std::uint32_t v = 0; v < welded.size(); ++v)
        welded[v] = first.try_emplace(scene.positions[v], v).first->second;
    return welded;
}

/// Three vertices in ascending order, and whether that took an odd number of swaps.
struct OrientedKey {
    std::array<std::uint32_t, 3> vertices;
    bool odd = false;
};

OrientedKey orientedKey(const Triangle& t, const std::vector<std::uint32_t>& welded) {
    OrientedKey key{{welded[t.vertex[0]], welded[t.vertex[1]], welded[t.vertex[2]]}};
    const auto order = [&](int i, int j) {
        if (key.vertices[i] <= key.vertices[j]) return;
        std::swap(key.vertices[i], key.vertices[j]);
        key.odd = !key.odd;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return key;
}

struct KeyHash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& k) const {
        std::uint64_t h = (static_cast<std::uint64_t>(k[0]) << 32 | k[1]) * 0x9e3779b97f4a7c15ull;
        h ^= (h >> 29) + k[2] * 0xd1342543de82ef95ull;
        return static_cast<std::size_t>(h ^ (h >> 31));
    }
};

/// Indices of material copies that emit on both sides.
class BothSidedMaterials {
  public:
    explicit BothSidedMaterials(Scene& scene) : scene_(scene) {}

    std::uint32_t of(std::uint32_t material) {
        if (scene_.materials[material].emitsBothSides) return material;
        const auto [entry, isNew] =
            copies_.try_emplace(material, static_cast<std::uint32_t>(scene_.materials.size()));
        if (isNew) {
            Material copy = scene_.materials[material];
            copy.emitsBothSides = true;
            scene_.materials.push_back(std::move(copy));
        }
        return entry->second;
    }

  private:
    Scene& scene_;
    std::unordered_map<std::uint32_t, std::uint32_t> copies_;
};

/// Of triangles at the same place the first of each winding is kept, and of two windings with the
/// same material only the first; an emitter that had both emits from both sides.
void dropDuplicates(Scene& scene, ImportReport& report) {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    const std::vector<std::uint32_t> welded = weldedVertices(scene);
    std::unordered_map<std::array<std::uint32_t, 3>, std::array<std::uint32_t, 2>, KeyHash> kept;
    kept.reserve(scene.triangles.size());
    BothSidedMaterials bothSided(scene);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        Triangle& triangle = scene.triangles[t];
        if (triangle.material == kDropped) continue;
        const OrientedKey key = orientedKey(triangle, welded);
        auto& slots = kept.try_emplace(key.vertices, std::array{kNone, kNone}).first->second;
        const std::uint32_t other = slots[!key.odd];
        const bool isRepeat = slots[key.odd] != kNone;
        const bool isOtherSide =
            !isRepeat && other != kNone && scene.triangles[other].material == triangle.material;
        if (!isRepeat) slots[key.odd] = t;
        if (!isRepeat && !isOtherSide) continue;
        if (isOtherSide && scene.materials[triangle.material].isEmitter())
            scene.triangles[other].material = bothSided.of(triangle.material);
        triangle.material = kDropped;
        ++report.duplicateTriangles;
    }
}

/// Removes the dropped triangles, and the meshes that have none left.
void compactTriangles(Scene& scene) {
    std::vector<std::uint32_t> keptBefore{0};
    keptBefore.reserve(scene.triangles.size() + 1);
    for (const Triangle& t : scene.triangles)
        keptBefore.push_back(keptBefore.back() + (t.material != kDropped));
    for (Mesh& mesh : scene.meshes) {
        const std::uint32_t first = mesh.firstTriangle;
        mesh.firstTriangle = keptBefore[first];
        mesh.triangleCount = keptBefore[first + mesh.triangleCount] - mesh.firstTriangle;
    }
    std::erase_if(scene.meshes, [](const Mesh& mesh) { return mesh.triangleCount == 0; });
    std::erase_if(scene.triangles, [](const Triangle& t) { return t.material == kDropped; });
}

void dropUnusedVertices(Scene& scene) {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> renumbered(scene.positions.size(), kUnused);
    for (const Triangle& t : scene.triangles)
        for (const std::uint32_t v : t.vertex) renumbered[v] = 0;
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < renumbered.size(); ++v) {
        if (renumbered[v] == kUnused) continue;
        scene.positions[count] = scene.positions[v];
        scene.normals[count] = scene.normals[v];
        scene.uvs[count] = scene.uvs[v];
        renumbered[v] = count++;
    }
    scene.positions.resize(count);
    scene.normals.resize(count);
    scene.uvs.resize(count);
    for (Triangle& t : scene.triangles)
        for (std::uint32_t& v : t.vertex) v = renumbered[v];
}

/// Makes normals unit vectors. Missing and unusable ones become the area-weighted mean of their
/// triangles' normals; those that point behind all of them are turned round, since the winding
/// decides which side is the front.
void repairNormals(Scene& scene) {
    std::vector<glm::dvec3> means(scene.positions.size(), glm::dvec3(0));
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (const std::uint32_t v : scene.triangles[t].vertex)
            means[v] += glm::dvec3(areaVector(scene, t));
    for (std::size_t v = 0; v < means.size(); ++v) {
        glm::dvec3 normal = scene.normals[v];
        const double length = glm::length(normal), meanLength = glm::length(means[v]);
        if (length > 1e-12 && std::isfinite(length))
            normal /= length;
        else
            normal = meanLength > 0 ? means[v] / meanLength : glm::dvec3(0, 1, 0);
        scene.normals[v] = Vec3(glm::dot(normal, means[v]) < 0 ? -normal : normal);
    }
}

/// Largest value of a texture per channel, at least 1.
Vec3 textureMaximum(const Scene& scene, int texture) {
    Vec3 maximum(1);
    if (texture >= 0)
        for (const Vec3& pixel : scene.textures[texture].linear) maximum = glm::max(maximum, pixel);
    return maximum;
}

bool makeNonNegative(Vec3& v) {
    bool changed = false;
    for (int i = 0; i < 3; ++i) {
        if (v[i] >= 0 && std::isfinite(v[i])) continue;
        v[i] = 0;
        changed = true;
    }
    return changed;
}

void repairMaterial(const Scene& scene, Material& m, ImportReport& report) {
    const SourceLocation where{fmt::format("material '{}'", m.name), 0, ""};
    bool changed = makeNonNegative(m.diffuse);
    changed |= makeNonNegative(m.mirror);
    changed |= makeNonNegative(m.emission);
    if (changed) warn(report, where, "negative or infinite values are replaced by 0");
    if (maxComponent(m.emission) > kMostRadiance) {
        m.emission = glm::min(m.emission, Vec3(kMostRadiance));
        warn(report, where, fmt::format("emits more than {:g} W·m⁻²·sr⁻¹; limited", kMostRadiance));
    }
    const Vec3 sum = m.diffuse * textureMaximum(scene, m.diffuseTexture) +
                     m.mirror * textureMaximum(scene, m.mirrorTexture);
    const float most = maxComponent(sum);
    if (most <= 1) return;
    m.diffuse /= most;
    m.mirror /= most;
    if (most > 1.001f)
        warn(report, where,
             fmt::format("reflects {:.2f} times the light it receives; its "
                         "reflectances are scaled to 1",
                         most));
}

void repairUvs(Scene& scene, ImportReport& report) {
    const auto isFiniteUv = [](const Vec2& uv) { return isFinite(Vec3(uv, 0)); };
    if (std::all_of(scene.uvs.begin(), scene.uvs.end(), isFiniteUv)) return;
    std::replace_if(scene.uvs.begin(), scene.uvs.end(), std::not_fn(isFiniteUv), Vec2(0));
    warn(report, {"texture coordinates", 0, ""}, "those that are not finite are replaced by 0");
}

}  // namespace

void cleanScene(Scene& scene, ImportReport& report) {
    scene.normals.resize(scene.positions.size(), Vec3(0));
    scene.uvs.resize(scene.positions.size(), Vec2(0));
    for (Material& material : scene.materials) repairMaterial(scene, material, report);
    dropDegenerate(scene, report);
    dropDuplicates(scene, report);
    compactTriangles(scene);
    dropUnusedVertices(scene);
    repairUvs(scene, report);
    repairNormals(scene);
}

}  // namespace vlf
