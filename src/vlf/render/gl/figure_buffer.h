#pragma once
// Triangles of a figure: a position at shared::kFigurePositionAttribute and other data after it.

#include "vlf/render/gl/gl_object.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace vlf::gl {

/// Attribute shared::kFigureDataAttribute + i of a vertex.
struct FigureAttribute {
    int count;
    GLenum type;  ///< GL_FLOAT, GL_UNSIGNED_BYTE in [0, 1], or GL_UNSIGNED_INT as whole numbers
    std::size_t offset;
};

struct FigureBuffer {
    Buffer vertices;
    VertexArray array;
    int count = 0;
    std::uint64_t bytes = 0;
};

/// `count` vertices of `stride` bytes, which begin with the position.
FigureBuffer makeFigureBuffer(const void* vertices, std::size_t count, std::size_t stride,
                              std::initializer_list<FigureAttribute> attributes);

}  // namespace vlf::gl
