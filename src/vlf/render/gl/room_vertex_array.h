#pragma once
// How vertices of rooms and objects lie in their buffers.

#include "vlf/render/gl/gl_object.h"

namespace vlf::gl {

/// Of buffers of RoomVertex and of 32-bit indices.
VertexArray makeRoomVertexArray(const Buffer& vertices, const Buffer& indices);

}  // namespace vlf::gl
