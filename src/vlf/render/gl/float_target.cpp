#include "vlf/render/gl/float_target.h"

namespace vlf::gl {

namespace {

TextureObject image(GLenum format, int width, int height) {
    TextureObject texture = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, format, width, height);
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    return texture;
}

}  // namespace

FloatTarget::FloatTarget(int w, int h)
    : width(w),
      height(h),
      color(image(GL_RGBA32F, w, h)),
      depth(image(GL_DEPTH_COMPONENT32F, w, h)),
      framebuffer(makeFramebuffer()) {
    glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
    glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
}

}  // namespace vlf::gl
