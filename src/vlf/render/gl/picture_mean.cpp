#include "vlf/render/gl/picture_mean.h"

#include "vlf/render/gl/gl_state.h"
#include "vlf/render/gl/tone_data.h"

namespace vlf::gl {

using namespace shared;

PictureMean::PictureMean(const std::string& shaderFolder)
    : shaders_(shaderFolder),
      viewBuffer_(makeBuffer(nullptr, sizeof(ViewData), GL_DYNAMIC_STORAGE_BIT)) {
    add_ = shaders_.program("picture_mean", {{"ADD", 1}});
    show_ = shaders_.program("picture_mean", {});
}

void PictureMean::resize(int width, int height) {
    sum_ = FloatTarget(width, height);
}

void PictureMean::clear() const {
    const float zero[4] = {0, 0, 0, 0};
    glClearTexImage(sum_.color.id(), 0, GL_RGBA, GL_FLOAT, zero);
}

void PictureMean::add(const FloatTarget& picture, int width, int height, float weight,
                      const PixelRectangle& part) const {
    const StateGuard guard;
    glBindFramebuffer(GL_FRAMEBUFFER, sum_.framebuffer.id());
    glViewport(0, 0, sum_.width, sum_.height);
    glScissor(part.x, part.y, part.width, part.height);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glProgramUniform1f(add_, kWeightLocation, weight);
    draw(add_, picture, width, height);
}

void PictureMean::show(const View& view, const RenderSettings& settings, GLuint framebuffer) const {
    const StateGuard guard;
    ViewData data{};
    data.tone = toneData(settings);
    glNamedBufferSubData(viewBuffer_.id(), 0, sizeof data, &data);
    glBindBufferBase(GL_UNIFORM_BUFFER, kViewBlock, viewBuffer_.id());
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(view.x, view.y, view.width, view.height);
    glScissor(view.x, view.y, view.width, view.height);
    glDisable(GL_BLEND);
    draw(show_, sum_, sum_.width, sum_.height);
}

void PictureMean::draw(GLuint program, const FloatTarget& picture, int width, int height) const {
    for (const GLenum off : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_FRAMEBUFFER_SRGB})
        glDisable(off);
    glEnable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindSampler(kPictureUnit, 0);
    glBindTextureUnit(kPictureUnit, picture.color.id());
    glProgramUniform2f(program, kSizeLocation, static_cast<float>(width),
                       static_cast<float>(height));
    glUseProgram(program);
    glBindVertexArray(nothing_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace vlf::gl
