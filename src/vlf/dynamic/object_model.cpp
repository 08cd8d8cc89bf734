#include "vlf/dynamic/object_model.h"

#include "vlf/base/error.h"
#include "vlf/dynamic/subdivide.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace vlf {

namespace {

constexpr std::size_t kMaxTriangles = std::size_t{1} << 26;

/// Whether every edge, its ends told by position, is of one triangle each way.
bool isClosed(const Scene& scene) {
    const auto less = [](const Vec3& a, const Vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<Vec3, int, decltype(less)> ids(less);
    std::map<std::pair<int, int>, int> balance;
    for (const Triangle& t : scene.triangles)
        for (int c = 0; c < 3; ++c) {
            const auto id = [&](int corner) {
                return ids
                    .try_emplace(scene.positions[t.vertex[corner % 3]],
                                 static_cast<int>(ids.size()))
                    .first->second;
            };
            const int a = id(c), b = id(c + 1);
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    return std::all_of(balance.begin(), balance.end(), [](const auto& e) { return e.second == 0; });
}

/// Of the winding normals of a closed mesh: -1 where they point inwards.
float outwardSign(const Scene& scene) {
    double volume = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        volume += glm::dot(scene.position(t, 0) - scene.position(0, 0), areaVector(scene, t));
    return volume < 0 ? -1.0f : 1.0f;
}

/// Whether no vertex lies above the plane of any triangle; of large meshes it is not known.
bool isConvex(const Scene& scene, float radius) {
    constexpr std::size_t kMostPairs = std::size_t{1} << 24;
    if (scene.triangles.size() * scene.positions.size() > kMostPairs) return false;
    const float slack = 1e-5f * radius, outward = outwardSign(scene);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const Vec3 normal = outward * geometricNormal(scene, t), at = scene.position(t, 0);
        if (std::ranges::any_of(scene.positions,
                                [&](const Vec3& p) { return glm::dot(normal, p - at) > slack; }))
            return false;
    }
    return true;
}

/// Place of a direction on a path over the sphere, along bands of equal area to and fro: what is
/// near on the path is near on the sphere.
float placeOnSphere(const Vec3& direction) {
    constexpr float kBands = 8;
    const float height = 0.5f + 0.5f * direction.z / std::max(glm::length(direction), 1e-30f);
    const float band = std::min(std::floor(kBands * height), kBands - 1);
    const float turn = 0.5f + 0.5f / kPi * std::atan2(direction.y, direction.x);
    return band + (std::fmod(band, 2.0f) == 0 ? turn : 1 - turn);
}

/// Systematic sampling: along the triangles, those that face alike one after the other, a point for
/// every part of the area; any number of the points that lie evenly in the row faces all ways.
float spreadPatches(const Scene& scene, std::span<SurfacePatch> patches) {
    std::vector<std::pair<float, std::uint32_t>> order;
    double all = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        order.emplace_back(placeOnSphere(areaVector(scene, t)), t);
        all += area(scene, t);
    }
    std::sort(order.begin(), order.end());
    const float outward = outwardSign(scene);
    const double part = all / static_cast<double>(patches.size());
    double passed = 0;
    std::uint32_t next = 0;
    for (const auto& [place, t] : order) {
        passed += area(scene, t);
        const bool last = t == order.back().second;
        for (std::uint32_t k = 0; next < patches.size() && (last || (next + 0.5) * part < passed);
             ++k, ++next)
            patches[next] = {positionAt(scene, t, sampleUniformTriangle(r2Point(k, Vec2(0.5f)))),
                             outward * geometricNormal(scene, t)};
    }
    return static_cast<float>(part);
}

}  // namespace

ObjectMesh::ObjectMesh(Scene mesh) : scene(std::move(mesh)), rays(scene), closed(isClosed(scene)) {}

ObjectModel::ObjectModel(Scene scene) {
    makeGlossDiffuse(scene);
    dropGlass(scene);
    if (scene.triangles.empty())
        throw InputError("an object needs at least one triangle that is not glass");
    bounds_ = boundingSphere(scene);
    patchArea_ = spreadPatches(scene, patches_);
    emits_ = hasEmitter(scene);
    mirrors_ = hasMirror(scene);
    base_ = std::make_unique<const ObjectMesh>(std::move(scene));
    convex_ = base_->closed && isConvex(base_->scene, bounds_.radius);
}

const ObjectMesh& ObjectModel::mesh(int subdivision) const {
    if (subdivision <= 0) return *base_;
    const int level = std::min(subdivision, kMaxSubdivision);
    if (scene().triangles.size() << (2 * level) > kMaxTriangles)
        throw InputError("the object is too fine already to be subdivided " +
                         std::to_string(level) + " times");
    const ObjectMesh& coarser = mesh(level - 1);
    const std::lock_guard lock(mutex_);
    auto& made = subdivided_[static_cast<std::size_t>(level - 1)];
    if (!made) made = std::make_unique<const ObjectMesh>(subdivide(coarser.scene));
    return *made;
}

}  // namespace vlf
