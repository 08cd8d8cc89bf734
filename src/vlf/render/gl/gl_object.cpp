#include "vlf/render/gl/gl_object.h"

#include "vlf/base/error.h"

#include <atomic>
#include <string>

namespace vlf::gl {

namespace {

constexpr std::size_t kLarge = 1 << 20;  // bytes; asking after an error takes time

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
    if (bytes > kLarge && glGetError() == GL_OUT_OF_MEMORY)
        throw InputError("the GPU has no room for another " + std::to_string(bytes) +
                         " bytes; limit what the room takes (--gpu-memory), bake it coarser, or "
                         "render with --backend cpu");
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
