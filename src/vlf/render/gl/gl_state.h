#pragma once
// Leaves a host program's OpenGL state as it was.

#include "vlf/render/gl/shaders/shared.h"

#include <array>

#include <epoxy/gl.h>

namespace vlf::gl {

/// Notes the state that the renderer changes and puts it back at the end of its life.
class StateGuard {
  public:
    StateGuard();
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

  private:
    static constexpr std::array<GLenum, 7> kSwitches{
        GL_DEPTH_TEST,       GL_CULL_FACE,          GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST,
        GL_FRAMEBUFFER_SRGB, GL_POLYGON_OFFSET_FILL};
    struct Unit {
        GLint texture2d, bufferTexture, sampler;
    };

    std::array<GLboolean, kSwitches.size()> switches_{};
    std::array<Unit, shared::kUnits> units_{};
    GLint cubes_ = 0;
    std::array<GLint, 6> uniformBuffers_{};
    std::array<GLint, 4> viewport_{}, scissor_{};
    std::array<GLboolean, 4> colorMask_{};
    std::array<GLfloat, 4> clearColor_{};
    GLfloat clearDepth_ = 1, offsetFactor_ = 0, offsetUnits_ = 0;
    GLboolean depthMask_ = GL_TRUE;
    GLint program_ = 0, vertexArray_ = 0, drawBuffer_ = 0, readBuffer_ = 0, activeTexture_ = 0;
    GLint blendEquation_[2] = {0, 0}, blendFunction_[4] = {0, 0, 0, 0};
    GLint depthFunction_ = 0, cullFace_ = 0, frontFace_ = 0, uniformBuffer_ = 0;
};

}  // namespace vlf::gl
