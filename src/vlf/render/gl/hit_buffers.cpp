#include "vlf/render/gl/hit_buffers.h"

#include "vlf/base/error.h"
#include "vlf/render/gl/hit_surfaces.h"
#include "vlf/render/gl/shaders/shared.h"
#include "vlf/trace/bvh.h"

#include <algorithm>

namespace vlf::gl {

namespace {

constexpr std::size_t kLeast = 16;  // bytes: a buffer without any is an error in OpenGL

template <class Item>
std::size_t sizeOf(const std::vector<Item>& items) {
    return sizeof(Item) * items.size();
}

}  // namespace

HitBuffers::HitBuffers() {
    const auto make = [&](Kind kind, int unit, GLenum format, std::size_t texelBytes) {
        Row& row = rows_[kind];
        row.unit = unit;
        row.format = format;
        row.texelBytes = texelBytes;
        row.texture = makeTexture(GL_TEXTURE_BUFFER);
        reserve(row, kLeast);
        show(row);
    };
    make(nodes, shared::kBvhNodeUnit, GL_RGBA32F, 16);
    make(triangles, shared::kBvhTriangleUnit, GL_RGBA32F, 16);
    make(records, shared::kHitRecordUnit, GL_RGBA32UI, 16);
    make(texels, shared::kHitTexelUnit, GL_R32UI, 4);
    make(mirrors, shared::kMirrorTriangleUnit, GL_R32UI, 4);
}

void HitBuffers::loadRoom(const Scene& scene, const std::vector<Chart>& charts,
                          const std::vector<TriangleCharts>& triangleCharts,
                          const std::vector<std::uint32_t>& mirrorTriangles) {
    const Bvh bvh = buildBvh(scene);
    const HitSurfaces surfaces = makeHitSurfaces(scene, charts, triangleCharts);
    setRoom(nodes, bvh.nodes);
    setRoom(triangles, bvh.triangles);
    setRoom(records, surfaces.records);
    setRoom(texels, surfaces.texels);
    setRoom(mirrors, mirrorTriangles);
    hasRoom_ = true;
}

std::uint32_t HitBuffers::roomNodes() const {
    return static_cast<std::uint32_t>(rows_[nodes].roomBytes / sizeof(BvhNode));
}

std::vector<BodyPlace> HitBuffers::loadObjects(std::span<const ObjectGeometry* const> objects) {
    std::array<std::size_t, kinds> needed{};
    for (std::size_t k = 0; k < kinds; ++k) needed[k] = rows_[k].roomBytes;
    for (const ObjectGeometry* o : objects) {
        needed[nodes] += sizeOf(o->bvh.nodes);
        needed[triangles] += sizeOf(o->bvh.triangles);
        needed[records] += sizeOf(o->surfaces.records);
        needed[texels] += sizeOf(o->surfaces.texels);
    }
    for (std::size_t k = 0; k < kinds; ++k) {
        reserve(rows_[k], needed[k]);
        rows_[k].bytes = rows_[k].roomBytes;
    }
    std::vector<BodyPlace> places;
    const auto next = [&](Kind kind, std::size_t itemBytes) {
        return static_cast<std::uint32_t>(rows_[kind].bytes / itemBytes);
    };
    for (const ObjectGeometry* o : objects) {
        places.push_back({next(nodes, sizeof(BvhNode)),
                          static_cast<std::uint32_t>(o->bvh.nodes.size()),
                          next(triangles, sizeof(BvhTriangle)),
                          next(records, sizeof(HitSurfaces::Texel)), next(texels, 4)});
        append(nodes, o->bvh.nodes);
        append(triangles, o->bvh.triangles);
        append(records, o->surfaces.records);
        append(texels, o->surfaces.texels);
    }
    for (Row& row : rows_) show(row);
    return places;
}

template <class Item>
void HitBuffers::setRoom(Kind kind, const std::vector<Item>& items) {
    Row& row = rows_[kind];
    row.roomBytes = row.bytes = 0;
    reserve(row, sizeOf(items));
    append(kind, items);
    row.roomBytes = row.bytes;
    show(row);
}

/// Keeps the room's part.
void HitBuffers::reserve(Row& row, std::size_t bytes) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (bytes / row.texelBytes > static_cast<std::size_t>(most))
        throw InputError(
            "the scene, its objects or their textures exceed what this GPU holds for traced "
            "reflections: without objects show it in mode field, or render with --backend cpu");
    if (row.buffer && bytes <= row.capacity) return;
    row.capacity = std::max(bytes, kLeast);
    Buffer larger = makeBuffer(nullptr, row.capacity, GL_DYNAMIC_STORAGE_BIT);
    if (row.roomBytes > 0)
        glCopyNamedBufferSubData(row.buffer.id(), larger.id(), 0, 0,
                                 static_cast<GLsizeiptr>(row.roomBytes));
    row.buffer = std::move(larger);
}

template <class Item>
void HitBuffers::append(Kind kind, const std::vector<Item>& items) {
    Row& row = rows_[kind];
    if (items.empty()) return;
    glNamedBufferSubData(row.buffer.id(), static_cast<GLintptr>(row.bytes),
                         static_cast<GLsizeiptr>(sizeOf(items)), items.data());
    row.bytes += sizeOf(items);
}

void HitBuffers::show(Row& row) {
    glTextureBufferRange(row.texture.id(), row.format, row.buffer.id(), 0,
                         static_cast<GLsizeiptr>(std::max(row.bytes, kLeast)));
}

void HitBuffers::bind() const {
    for (const Row& row : rows_) glBindTextureUnit(static_cast<GLuint>(row.unit), row.texture.id());
}

std::uint64_t HitBuffers::bytes() const {
    std::uint64_t sum = 0;
    for (const Row& row : rows_) sum += row.capacity;
    return sum;
}

}  // namespace vlf::gl
