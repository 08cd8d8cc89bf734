#include "vlf/render/gl/figure_buffer.h"

#include "vlf/render/gl/shaders/drawing_data.h"

namespace vlf::gl {

FigureBuffer makeFigureBuffer(const void* vertices, std::size_t count, std::size_t stride,
                              std::initializer_list<FigureAttribute> attributes) {
    FigureBuffer figure;
    figure.count = static_cast<int>(count);
    figure.bytes = count * stride;
    figure.vertices = makeBuffer(vertices, figure.bytes);
    figure.array = makeVertexArray();
    const GLuint id = figure.array.id();
    glVertexArrayVertexBuffer(id, 0, figure.vertices.id(), 0, static_cast<GLsizei>(stride));
    const auto enable = [&](GLuint attribute) {
        glVertexArrayAttribBinding(id, attribute, 0);
        glEnableVertexArrayAttrib(id, attribute);
    };
    glVertexArrayAttribFormat(id, shared::kFigurePositionAttribute, 3, GL_FLOAT, GL_FALSE, 0);
    enable(shared::kFigurePositionAttribute);
    GLuint attribute = shared::kFigureDataAttribute;
    for (const FigureAttribute& a : attributes) {
        const auto offset = static_cast<GLuint>(a.offset);
        if (a.type == GL_UNSIGNED_INT)
            glVertexArrayAttribIFormat(id, attribute, a.count, a.type, offset);
        else
            glVertexArrayAttribFormat(id, attribute, a.count, a.type, GL_TRUE, offset);
        enable(attribute++);
    }
    return figure;
}

}  // namespace vlf::gl
