#include "vlf/render/gl/gl_object.h"

#include <atomic>

namespace vlf::gl {

namespace {

std::atomic<int> objects{0};

template <class Create>
GLuint made(Create create) {
    GLuint id = 0;
    create(&id);
    return id;
}

}  // namespace

int liveObjects() {
    return objects;
}

void detail::countObjects(int change) {
    objects += change;
}

Buffer makeBuffer(const void* data, std::size_t bytes, GLbitfield flags) {
    Buffer buffer(made([](GLuint* id) { glCreateBuffers(1, id); }));
    // A buffer without bytes is an error in OpenGL.
    if (bytes == 0)
        glNamedBufferStorage(buffer.id(), 16, nullptr, flags);
    else
        glNamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(bytes), data, flags);
    return buffer;
}

TextureObject makeTexture(GLenum target) {
    return TextureObject(made([&](GLuint* id) { glCreateTextures(target, 1, id); }));
}

TextureObject makeBufferTexture(const Buffer& buffer, GLenum format) {
    TextureObject texture = makeTexture(GL_TEXTURE_BUFFER);
    glTextureBuffer(texture.id(), format, buffer.id());
    return texture;
}

VertexArray makeVertexArray() {
    return VertexArray(made([](GLuint* id) { glCreateVertexArrays(1, id); }));
}

Framebuffer makeFramebuffer() {
    return Framebuffer(made([](GLuint* id) { glCreateFramebuffers(1, id); }));
}

Query makeQuery(GLenum target) {
    return Query(made([&](GLuint* id) { glCreateQueries(target, 1, id); }));
}

}  // namespace vlf::gl
