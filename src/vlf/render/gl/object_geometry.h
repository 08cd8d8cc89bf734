#pragma once
// An object's mesh as the GPU draws and traces it, in the object's own space; as plain data.

#include "vlf/dynamic/lit_object.h"
#include "vlf/render/gl/hit_surfaces.h"
#include "vlf/render/gl/room_geometry.h"
#include "vlf/trace/bvh.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Vertices are as the room's, but that `mirror` numbers the vertex among
/// LitObject::vertexIrradiance, `mirrorNormal` is the shading normal on the side that is drawn, and
/// `atlasUv` is in texels of the object's atlas (zero where it is lit by vertex).
struct ObjectGeometry {
    std::vector<RoomVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<RoomBatch> batches;  ///< those of mirrors last
    HitSurfaces surfaces;            ///< charts are the object's; lit by vertex, one a material
    Bvh bvh;
    Sphere bounds;
};

/// `texels`: null where the object is lit by vertex. Throws InputError as makeHitSurfaces and
/// buildBvh do.
ObjectGeometry makeObjectGeometry(const ObjectMesh& mesh, const ObjectTexels* texels);

}  // namespace vlf
