#pragma once
// The meshes of objects in the memory of the GPU, each once, however many objects are of it.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/hit_buffers.h"
#include "vlf/render/gl/line_pass.h"
#include "vlf/render/gl/object_geometry.h"
#include "vlf/render/gl/scene_textures.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace vlf::gl {

struct GpuObjectMesh {
    /// `model`: the mesh's, kept as long as this is.
    GpuObjectMesh(std::shared_ptr<const ObjectModel> model, const LitObject& object);

    /// Whether it is what draws an object.
    bool draws(const LitObject& object) const;
    std::uint64_t bytes() const;
    bool hasMirrors() const { return !geometry.batches.empty() && geometry.batches.back().mirror; }

    std::shared_ptr<const ObjectModel> model;
    const ObjectMesh* mesh;
    const ObjectTexels* texels;
    std::uint64_t chartSum;  ///< tells charts apart
    ObjectGeometry geometry;
    Buffer vertices, indices;
    VertexArray vertexArray;
    std::vector<Buffer> materials;  ///< of each batch
    SceneTextures textures;
    BodyPlace body;
    std::optional<LineBuffer> edges, normals;  ///< once drawn
};

class ObjectMeshes {
  public:
    /// Those of the room's lit objects and no others; `hits` holds their hierarchies then. Throws
    /// as makeObjectGeometry and HitBuffers::loadObjects; the next call tries again.
    void update(const DynamicRoom& room, HitBuffers& hits);

    /// Puts the hierarchies into other buffers, or into those that have a room now.
    void reload(HitBuffers& hits);

    std::size_t size() const { return meshes_.size(); }
    GpuObjectMesh& mesh(std::size_t i) const { return *meshes_[i]; }
    /// The number of a lit object's mesh.
    std::size_t meshOf(std::size_t object) const { return meshOf_[object]; }

    std::uint64_t bytes() const;

  private:
    std::size_t find(const LitObject& object) const;

    std::vector<std::unique_ptr<GpuObjectMesh>> meshes_;
    std::vector<std::size_t> meshOf_;
    std::vector<bool> used_;
    bool stale_ = false;  ///< the hierarchies are not those of the meshes
};

}  // namespace vlf::gl
