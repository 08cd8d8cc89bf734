#include "vlf/render/gl/hit_buffers.h"

#include "vlf/base/error.h"
#include "vlf/render/gl/hit_surfaces.h"
#include "vlf/render/gl/shaders/shared.h"
#include "vlf/trace/bvh.h"

namespace vlf::gl {

HitBuffers::HitBuffers(const Scene& scene, const std::vector<Chart>& charts,
                       const std::vector<TriangleCharts>& triangleCharts,
                       const std::vector<std::uint32_t>& mirrorTriangles) {
    const Bvh bvh = buildBvh(scene);
    add(shared::kBvhNodeUnit, bvh.nodes, GL_RGBA32F, 16);
    add(shared::kBvhTriangleUnit, bvh.triangles, GL_RGBA32F, 16);
    const HitSurfaces surfaces = makeHitSurfaces(scene, charts, triangleCharts);
    add(shared::kHitRecordUnit, surfaces.records, GL_RGBA32UI, 16);
    add(shared::kHitTexelUnit, surfaces.texels, GL_R32UI, 4);
    add(shared::kMirrorTriangleUnit, mirrorTriangles, GL_R32UI, 4);
}

template <class Item>
void HitBuffers::add(int unit, const std::vector<Item>& items, GLenum format,
                     std::size_t texelBytes) {
    const std::size_t bytes = sizeof(Item) * items.size();
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (bytes / texelBytes > static_cast<std::size_t>(most))
        throw InputError(
            "the scene or its textures exceed what this GPU holds for traced "
            "reflections: show it in mode field, or render with --backend cpu");
    Buffer buffer = makeBuffer(items.data(), bytes);
    TextureObject texture = makeBufferTexture(buffer, format);
    rows_.push_back({unit, std::move(buffer), std::move(texture)});
    bytes_ += bytes;
}

void HitBuffers::bind() const {
    for (const Row& row : rows_) glBindTextureUnit(static_cast<GLuint>(row.unit), row.texture.id());
}

}  // namespace vlf::gl
