#include "vlf/render/gl/room_vertex_array.h"

#include "vlf/render/gl/room_geometry.h"
#include "vlf/render/gl/shaders/shared.h"

#include <cstddef>

namespace vlf::gl {

using namespace shared;

VertexArray makeRoomVertexArray(const Buffer& vertices, const Buffer& indices) {
    VertexArray array = makeVertexArray();
    const GLuint id = array.id();
    glVertexArrayVertexBuffer(id, 0, vertices.id(), 0, sizeof(RoomVertex));
    glVertexArrayElementBuffer(id, indices.id());
    const auto floats = [&](GLuint attribute, int count, std::size_t offset) {
        glVertexArrayAttribFormat(id, attribute, count, GL_FLOAT, GL_FALSE,
                                  static_cast<GLuint>(offset));
    };
    floats(kPositionAttribute, 3, offsetof(RoomVertex, position));
    glVertexArrayAttribFormat(id, kGeometricNormalAttribute, 2, GL_SHORT, GL_TRUE,
                              offsetof(RoomVertex, geometricNormal));
    glVertexArrayAttribFormat(id, kMirrorNormalAttribute, 2, GL_SHORT, GL_TRUE,
                              offsetof(RoomVertex, mirrorNormal));
    floats(kUvAttribute, 2, offsetof(RoomVertex, uv));
    floats(kAtlasUvAttribute, 2, offsetof(RoomVertex, atlasUv));
    glVertexArrayAttribIFormat(id, kMirrorAttribute, 1, GL_UNSIGNED_INT,
                               offsetof(RoomVertex, mirror));
    for (int a = kPositionAttribute; a <= kMirrorNormalAttribute; ++a) {
        glVertexArrayAttribBinding(id, static_cast<GLuint>(a), 0);
        glEnableVertexArrayAttrib(id, static_cast<GLuint>(a));
    }
    return array;
}

}  // namespace vlf::gl
