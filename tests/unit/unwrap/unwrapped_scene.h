#pragma once
// A scene with its charts, and scenes that several tests unwrap.

#include "vlf/unwrap/unwrap.h"

#include "support/analytic_scenes.h"

namespace vlf::test {

struct UnwrappedScene {
    UnwrappedScene(const Scene& sceneToUnwrap, const UnwrapParams& params)
        : scene(sceneToUnwrap), rays(scene), unwrap(vlf::unwrap(scene, rays, params)) {}

    Scene scene;
    RayScene rays;
    Unwrap unwrap;

    /// The side of its triangle on which the texels of `chart` lie.
    bool isFront(std::uint32_t triangle, std::uint32_t chart) const {
        return unwrap.triangleCharts[triangle].front == chart;
    }
    Vec3 position(const SurfacePoint& p) const {
        return positionAt(scene, p.triangle, p.barycentric);
    }
};

/// A closed room of 4 x 3 x 4 m with a lamp below its ceiling, for furniture to be put in.
/// Triangles 0..11 are the room's, 12 and 13 the lamp's.
inline SceneBuilder litRoom(bool inwards = true) {
    SceneBuilder b;
    b.box(Vec3(0), {4, 3, 4}, inwards, b.material("wall", Vec3(0.7f)));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(10));
    b.quad({1.5f, 2.9f, 1.5f}, {1, 0, 0}, {0, 0, 1}, lamp);
    return b;
}

/// Index range of the last mesh's triangles.
inline std::pair<std::uint32_t, std::uint32_t> lastMesh(const Scene& scene) {
    const Mesh& mesh = scene.meshes.back();
    return {mesh.firstTriangle, mesh.firstTriangle + mesh.triangleCount};
}

}  // namespace vlf::test
