#pragma once
// An object with the light that is on it now: what renderers draw.

#include "vlf/dynamic/object_model.h"
#include "vlf/field/chart.h"
#include "vlf/field/irradiance_atlas.h"
#include "vlf/math/pose.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// Texels of an object, in the model's space.
struct ObjectTexels {
    std::vector<Chart> charts;
    std::vector<TriangleCharts> triangleCharts;  ///< one per triangle of mesh(0)
};

/// Irradiance (W·m⁻²) is given by vertex or by texel.
struct LitObject {
    const ObjectMesh* mesh = nullptr;
    Pose pose;
    std::span<const Vec3> vertexIrradiance;  ///< mesh->sidedVertexCount() entries; empty: by texel
    const ObjectTexels* texels = nullptr;    ///< null: by vertex
    const IrradianceAtlas* atlas = nullptr;
    std::uint64_t version = 0;  ///< another one whenever the light, the mesh or the object is

    /// At barycentric coordinates of the second and third vertex; zero on the inside of a solid.
    Vec3 irradiance(std::uint32_t triangle, const Vec2& barycentric, bool front) const;
};

}  // namespace vlf
