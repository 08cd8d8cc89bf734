#pragma once
// OpenGL objects that delete themselves, and how many there are.

#include <cstddef>
#include <utility>

#include <epoxy/gl.h>

namespace vlf::gl {

/// Objects that exist, over all kinds and contexts. For tests of leaks.
int liveObjects();

namespace detail {
void countObjects(int change);

/// A name made by `create` and given back by `destroy`.
template <class Kind>
class Object {
  public:
    Object() = default;
    explicit Object(GLuint id) : id_(id) { countObjects(1); }
    ~Object() { reset(); }
    Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0);
        }
        return *this;
    }

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

  private:
    void reset() {
        if (id_ == 0) return;
        Kind::destroy(id_);
        countObjects(-1);
        id_ = 0;
    }

    GLuint id_ = 0;
};

struct BufferKind {
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct TextureKind {
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct VertexArrayKind {
    static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct FramebufferKind {
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct QueryKind {
    static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};
struct ProgramKind {
    static void destroy(GLuint id) { glDeleteProgram(id); }
};
struct ShaderKind {
    static void destroy(GLuint id) { glDeleteShader(id); }
};
}  // namespace detail

using Buffer = detail::Object<detail::BufferKind>;
using TextureObject = detail::Object<detail::TextureKind>;
using VertexArray = detail::Object<detail::VertexArrayKind>;
using Framebuffer = detail::Object<detail::FramebufferKind>;
using Query = detail::Object<detail::QueryKind>;
using Program = detail::Object<detail::ProgramKind>;
using Shader = detail::Object<detail::ShaderKind>;

/// An immutable buffer of `bytes`; `flags` as of glNamedBufferStorage.
Buffer makeBuffer(const void* data, std::size_t bytes, GLbitfield flags = 0);
TextureObject makeTexture(GLenum target);
/// The buffer seen as a row of texels.
TextureObject makeBufferTexture(const Buffer& buffer, GLenum format);
VertexArray makeVertexArray();
Framebuffer makeFramebuffer();
Query makeQuery(GLenum target);

}  // namespace vlf::gl
