#include "vlf/render/gl/exposure_meter.h"

#include "vlf/image/tone_map.h"

namespace vlf::gl {

namespace {

TextureObject makeImage(GLenum format, int width, int height) {
    TextureObject texture = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, format, width, height);
    return texture;
}

}  // namespace

ExposureMeter::ExposureMeter()
    : color_(makeImage(GL_RGBA32F, kWidth, kHeight)),
      depth_(makeImage(GL_DEPTH_COMPONENT32F, kWidth, kHeight)),
      framebuffer_(makeFramebuffer()),
      pixels_(makeBuffer(nullptr, sizeof(Vec3) * kWidth * kHeight, GL_CLIENT_STORAGE_BIT)) {
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, color_.id(), 0);
    glNamedFramebufferTexture(framebuffer_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
}

ExposureMeter::~ExposureMeter() {
    if (drawn_) glDeleteSync(drawn_);
}

void ExposureMeter::measure(Renderer& renderer, const Camera& camera, float aspect) {
    if (drawn_) return;
    View view = viewOf(camera, kWidth, kHeight, renderer.nearest());
    // The picture of the window, squeezed to the shape of the small one.
    const float squeeze = static_cast<float>(kWidth) / kHeight / aspect;
    for (int axis = 0; axis < 4; ++axis) view.clipFromWorld[axis].x *= squeeze;
    RenderSettings settings;
    settings.tone.reset();
    if (!renderer.canLookUp()) settings.mode = DisplayMode::raytraced;
    renderer.draw(view, settings, framebuffer_.id());
    GLint bound = 0;
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &bound);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, pixels_.id());
    glGetTextureImage(color_.id(), 0, GL_RGB, GL_FLOAT, sizeof(Vec3) * kWidth * kHeight, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(bound));
    drawn_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

std::optional<float> ExposureMeter::exposure() {
    if (!drawn_) return exposure_;
    const GLenum status = glClientWaitSync(drawn_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    if (status != GL_ALREADY_SIGNALED && status != GL_CONDITION_SATISFIED) return exposure_;
    glDeleteSync(drawn_);
    drawn_ = nullptr;
    Image picture(kWidth, kHeight);
    glGetNamedBufferSubData(pixels_.id(), 0, sizeof(Vec3) * kWidth * kHeight,
                            picture.pixels.data());
    exposure_ = autoExposure(picture);
    return exposure_;
}

}  // namespace vlf::gl
