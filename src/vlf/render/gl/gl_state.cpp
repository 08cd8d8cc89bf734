#include "vlf/render/gl/gl_state.h"

namespace vlf::gl {

StateGuard::StateGuard() {
    for (std::size_t i = 0; i < kSwitches.size(); ++i) switches_[i] = glIsEnabled(kSwitches[i]);
    glGetIntegerv(GL_ACTIVE_TEXTURE, &activeTexture_);
    for (std::size_t i = 0; i < units_.size(); ++i) {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        glGetIntegerv(GL_TEXTURE_BINDING_2D, &units_[i].texture2d);
        glGetIntegerv(GL_TEXTURE_BINDING_BUFFER, &units_[i].bufferTexture);
        glGetIntegerv(GL_SAMPLER_BINDING, &units_[i].sampler);
    }
    glActiveTexture(GL_TEXTURE0 + shared::kProbeUnit);
    glGetIntegerv(GL_TEXTURE_BINDING_CUBE_MAP_ARRAY, &cubes_);
    glActiveTexture(static_cast<GLenum>(activeTexture_));
    for (std::size_t i = 0; i < uniformBuffers_.size(); ++i)
        glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, static_cast<GLuint>(i), &uniformBuffers_[i]);
    glGetIntegerv(GL_UNIFORM_BUFFER_BINDING, &uniformBuffer_);
    glGetIntegerv(GL_VIEWPORT, viewport_.data());
    glGetIntegerv(GL_SCISSOR_BOX, scissor_.data());
    glGetBooleanv(GL_COLOR_WRITEMASK, colorMask_.data());
    glGetFloatv(GL_COLOR_CLEAR_VALUE, clearColor_.data());
    glGetFloatv(GL_DEPTH_CLEAR_VALUE, &clearDepth_);
    glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &offsetFactor_);
    glGetFloatv(GL_POLYGON_OFFSET_UNITS, &offsetUnits_);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask_);
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertexArray_);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawBuffer_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &readBuffer_);
    glGetIntegerv(GL_BLEND_EQUATION_RGB, &blendEquation_[0]);
    glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &blendEquation_[1]);
    glGetIntegerv(GL_BLEND_SRC_RGB, &blendFunction_[0]);
    glGetIntegerv(GL_BLEND_DST_RGB, &blendFunction_[1]);
    glGetIntegerv(GL_BLEND_SRC_ALPHA, &blendFunction_[2]);
    glGetIntegerv(GL_BLEND_DST_ALPHA, &blendFunction_[3]);
    glGetIntegerv(GL_DEPTH_FUNC, &depthFunction_);
    glGetIntegerv(GL_CULL_FACE_MODE, &cullFace_);
    glGetIntegerv(GL_FRONT_FACE, &frontFace_);
}

StateGuard::~StateGuard() {
    for (std::size_t i = 0; i < kSwitches.size(); ++i)
        (switches_[i] ? glEnable : glDisable)(kSwitches[i]);
    for (std::size_t i = 0; i < units_.size(); ++i) {
        const auto unit = static_cast<GLuint>(i);
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(units_[i].texture2d));
        glBindTexture(GL_TEXTURE_BUFFER, static_cast<GLuint>(units_[i].bufferTexture));
        glBindSampler(unit, static_cast<GLuint>(units_[i].sampler));
    }
    glActiveTexture(GL_TEXTURE0 + shared::kProbeUnit);
    glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, static_cast<GLuint>(cubes_));
    glActiveTexture(static_cast<GLenum>(activeTexture_));
    for (std::size_t i = 0; i < uniformBuffers_.size(); ++i)
        glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(i),
                         static_cast<GLuint>(uniformBuffers_[i]));
    glBindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(uniformBuffer_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    glScissor(scissor_[0], scissor_[1], scissor_[2], scissor_[3]);
    glColorMask(colorMask_[0], colorMask_[1], colorMask_[2], colorMask_[3]);
    glClearColor(clearColor_[0], clearColor_[1], clearColor_[2], clearColor_[3]);
    glClearDepthf(clearDepth_);
    glPolygonOffset(offsetFactor_, offsetUnits_);
    glDepthMask(depthMask_);
    glUseProgram(static_cast<GLuint>(program_));
    glBindVertexArray(static_cast<GLuint>(vertexArray_));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawBuffer_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(readBuffer_));
    const auto e = [](GLint value) { return static_cast<GLenum>(value); };
    glBlendEquationSeparate(e(blendEquation_[0]), e(blendEquation_[1]));
    glBlendFuncSeparate(e(blendFunction_[0]), e(blendFunction_[1]), e(blendFunction_[2]),
                        e(blendFunction_[3]));
    glDepthFunc(static_cast<GLenum>(depthFunction_));
    glCullFace(static_cast<GLenum>(cullFace_));
    glFrontFace(static_cast<GLenum>(frontFace_));
}

}  // namespace vlf::gl
