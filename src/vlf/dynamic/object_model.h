#pragma once
// A mesh that is to move about in a baked room, in its own space.

#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <array>
#include <memory>
#include <mutex>

namespace vlf {

/// A mesh ready to be lit and traced, in the model's space.
struct ObjectMesh {
    Scene scene;
    RayScene rays;
    bool closed = true;  ///< every edge is of two triangles: light meets front sides only

    explicit ObjectMesh(Scene mesh);

    /// Places in a list of irradiances by vertex: those of the front sides and, unless the mesh is
    /// closed, as many of the back sides.
    std::size_t sidedVertexCount() const { return scene.positions.size() * (closed ? 1 : 2); }
};

/// A point of a surface, in the model's space.
struct SurfacePatch {
    Vec3 position, normal;  ///< unit, outward where the mesh is closed
};

/// Immutable but for meshes made when first asked for; safe to use from several threads.
class ObjectModel {
  public:
    static constexpr int kMaxSubdivision = 3;

    /// `scene` is any imported scene; its cameras are ignored, its rough mirrors reflect diffusely
    /// (makeGlossDiffuse). Throws InputError if it has no triangle.
    explicit ObjectModel(Scene scene);

    const Scene& scene() const { return base_->scene; }

    /// Of its vertices, about the middle of its box.
    const Sphere& bounds() const { return bounds_; }

    /// Points that stand for pieces of equal area, in an order in which those that face alike
    /// follow one another: every second or fourth of them stand for all, too.
    static constexpr int kPatches = 96;
    const std::array<SurfacePatch, kPatches>& patches() const { return patches_; }
    float patchArea() const { return patchArea_; }  ///< m²

    /// Closed, and no part of it hides another that faces the same way.
    bool convex() const { return convex_; }

    bool emits() const { return emits_; }
    bool mirrors() const { return mirrors_; }

    /// The mesh with every edge cut in half `subdivision` times, in [0, kMaxSubdivision]. Throws
    /// InputError if it would have more than 2^26 triangles.
    const ObjectMesh& mesh(int subdivision = 0) const;

  private:
    std::unique_ptr<const ObjectMesh> base_;
    Sphere bounds_;
    std::array<SurfacePatch, kPatches> patches_;
    float patchArea_ = 0;
    bool convex_ = false, emits_ = false, mirrors_ = false;
    mutable std::mutex mutex_;
    mutable std::array<std::unique_ptr<const ObjectMesh>, kMaxSubdivision> subdivided_;
};

}  // namespace vlf
