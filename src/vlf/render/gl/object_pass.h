#pragma once
// Draws the objects of a DynamicRoom.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/render/gl/changed_light.h"
#include "vlf/render/gl/object_lights.h"
#include "vlf/render/gl/object_meshes.h"
#include "vlf/render/gl/renderer.h"
#include "vlf/render/gl/shader_library.h"
#include "vlf/render/gl/shaders/shared.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf::gl {

/// Refers to the shaders, which must outlive it. Draws within StateGuard.
class ObjectPass {
  public:
    ObjectPass(ShaderLibrary& shaders, HitBuffers& hits);

    /// The room's lit objects as they are now.
    void update(const DynamicRoom& room);

    /// The buffers of hits have a room now.
    void hitsReloaded();

    bool empty() const { return count_ == 0; }

    /// Around each: centre, radius.
    const std::vector<Vec4>& spheres() const { return spheres_; }

    /// Places of the reflection probes that mirrors among the objects show, by layer.
    const std::vector<Vec3>& probeCentres() const { return probeCentres_; }

    /// What shaders are told of the light that the objects change, besides the objects.
    void setChange(const ChangedLight& change);

    /// Binds what shaders with OBJECTS read.
    void bind() const;

    /// In mode field or raytraced. `shadowed`: the room has hard shadows.
    void draw(const View& view, const RenderSettings& settings, bool shadowed) const;

    /// Triangles alone, of one object or all, with a program in use that has OBJECT, see
    /// object_place.glsl.
    void drawTriangles(std::size_t object) const;
    void drawTriangles() const;

    /// Edges and, if asked for, normals; see LinePass::draw.
    void drawLines(LinePass& lines, bool normals) const;

    std::uint64_t bytes() const;

  private:
    using Record = std::array<std::array<std::uint32_t, 4>, shared::kObjectTexels>;

    Record recordOf(const LitObject& object, std::size_t number);
    void placeBody(Record& record, std::size_t number) const;
    void loadRecords();
    void drawEach(std::size_t mesh, const RoomBatch& batch, const View& view) const;
    Defines definesOf(const GpuObjectMesh& mesh, const RoomBatch& batch,
                      const RenderSettings& settings, bool shadowed) const;

    ShaderLibrary& shaders_;
    HitBuffers& hits_;
    ObjectMeshes meshes_;
    ObjectLights lights_;
    std::vector<Record> records_;
    std::vector<Mat4> places_;
    std::vector<Vec4> spheres_;
    Buffer recordBuffer_, dataBuffer_;
    TextureObject recordTexture_;
    std::size_t capacity_ = 0, count_ = 0;
    std::vector<Vec3> probeCentres_;
    shared::ObjectsData data_{};
};

}  // namespace vlf::gl
