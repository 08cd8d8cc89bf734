#include "vlf/render/gl/object_meshes.h"

#include "vlf/render/gl/gpu_memory.h"
#include "vlf/render/gl/room_vertex_array.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace vlf::gl {

namespace {

std::uint64_t chartSumOf(const ObjectTexels* texels) {
    std::uint64_t sum = 0;
    if (!texels) return sum;
    for (const Chart& c : texels->charts)
        sum = 31 * sum + (std::uint64_t{c.x} << 32 | c.y) + std::bit_cast<std::uint32_t>(c.uOffset);
    return 31 * sum + texels->charts.size();
}

}  // namespace

GpuObjectMesh::GpuObjectMesh(std::shared_ptr<const ObjectModel> kept, const LitObject& object)
    : model(std::move(kept)),
      mesh(object.mesh),
      texels(object.texels),
      chartSum(chartSumOf(object.texels)),
      geometry(makeObjectGeometry(*object.mesh, object.texels)),
      vertices(makeBuffer(geometry.vertices.data(), geometry.vertices.size() * sizeof(RoomVertex))),
      indices(makeBuffer(geometry.indices.data(), geometry.indices.size() * 4)),
      vertexArray(makeRoomVertexArray(vertices, indices)),
      textures(object.mesh->scene) {
    for (const RoomBatch& batch : geometry.batches)
        materials.push_back(makeBuffer(&batch.data, sizeof batch.data));
}

bool GpuObjectMesh::draws(const LitObject& object) const {
    return mesh == object.mesh && texels == object.texels &&
           (!texels || chartSum == chartSumOf(texels));
}

std::uint64_t GpuObjectMesh::bytes() const {
    return geometry.vertices.size() * sizeof(RoomVertex) + 4 * geometry.indices.size() +
           textureBytes(mesh->scene) + (edges ? edges->bytes : 0) + (normals ? normals->bytes : 0);
}

std::size_t ObjectMeshes::find(const LitObject& object) const {
    std::size_t i = 0;
    while (i < meshes_.size() && !meshes_[i]->draws(object)) ++i;
    return i;
}

void ObjectMeshes::update(const DynamicRoom& room, HitBuffers& hits) {
    const auto objects = room.litObjects();
    meshOf_.resize(objects.size());
    used_.assign(meshes_.size(), false);
    for (std::size_t o = 0; o < objects.size(); ++o) {
        meshOf_[o] = find(objects[o]);
        if (meshOf_[o] == meshes_.size()) {
            meshes_.push_back(std::make_unique<GpuObjectMesh>(
                room.object(room.litNumbers()[o]).model, objects[o]));
            used_.push_back(true);
            stale_ = true;
        }
        used_[meshOf_[o]] = true;
    }
    for (std::size_t m = meshes_.size(); m-- > 0;) {
        if (used_[m]) continue;
        meshes_.erase(meshes_.begin() + static_cast<std::ptrdiff_t>(m));
        for (std::size_t& of : meshOf_) of -= of > m ? 1 : 0;
        stale_ = true;
    }
    if (stale_) reload(hits);
}

void ObjectMeshes::reload(HitBuffers& hits) {
    std::vector<const ObjectGeometry*> geometries;
    for (const auto& m : meshes_) geometries.push_back(&m->geometry);
    const std::vector<BodyPlace> places = hits.loadObjects(geometries);
    for (std::size_t m = 0; m < meshes_.size(); ++m) meshes_[m]->body = places[m];
    stale_ = false;
}

std::uint64_t ObjectMeshes::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& m : meshes_) sum += m->bytes();
    return sum;
}

}  // namespace vlf::gl
