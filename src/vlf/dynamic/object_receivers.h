#pragma once
// The points of an object at which its light is found: vertices or texels, in the model's space.

#include "vlf/dynamic/lit_object.h"
#include "vlf/dynamic/object.h"
#include "vlf/propagate/light_gatherer.h"
#include "vlf/unwrap/unwrap.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace vlf {

struct ObjectReceivers {
    const ObjectMesh* mesh = nullptr;
    std::vector<Vec3> position;
    std::vector<Vec3> normal;       ///< unit, of shading
    std::vector<Vec3> geometric;    ///< unit, of the surface; at a vertex the mean of those around
    std::vector<Vec3> reflectance;  ///< diffuse, mean over the receiver
    std::vector<LightReceiver> light;  ///< as receivers of direct light, their pose left open
    TexelPoints points;                ///< that `light` refers to

    /// Where they are texels; else receiver i is sided vertex i (ObjectMesh::sidedVertexCount).
    std::unique_ptr<const Unwrap> unwrap;
    ObjectTexels texels;
    std::vector<std::uint32_t>
        source;  ///< by atlas texel: the receiver that stands for it, or none

    std::size_t size() const { return position.size(); }
    bool areTexels() const { return unwrap != nullptr; }
    static constexpr std::uint32_t kNone = 0xffffffffu;

    /// The receiver nearest to a place on a side of a triangle; kNone on the inside of a solid.
    std::uint32_t at(std::uint32_t triangle, const Vec2& barycentric, bool front) const;
};

/// Charts and texels of mesh(0), about `texels`, or of the given size (metres) if that is above 0.
/// Throws InputError as unwrap does.
Unwrap unwrapObject(const ObjectModel& model, float texelSize, int texels);

/// Vertices of mesh(settings.subdivision), or texels, about `texels` if no size is given. `model`
/// must outlive them. Throws InputError as unwrap does.
std::unique_ptr<const ObjectReceivers> makeReceivers(const ObjectModel& model,
                                                     const GatherSettings& settings,
                                                     int texels = 200);

}  // namespace vlf
