#include "vlf/render/gl/scene_textures.h"

#include <algorithm>
#include <bit>

namespace vlf::gl {

namespace {

GLint wrapOf(Wrap wrap) {
    if (wrap == Wrap::repeat) return GL_REPEAT;
    return wrap == Wrap::mirror ? GL_MIRRORED_REPEAT : GL_CLAMP_TO_EDGE;
}

TextureObject upload(const vlf::Texture& source) {
    TextureObject texture = makeTexture(GL_TEXTURE_2D);
    const bool bytes = source.linear.empty();
    const auto size = static_cast<unsigned>(std::max(source.width, source.height));
    glTextureStorage2D(texture.id(), std::bit_width(size), bytes ? GL_SRGB8_ALPHA8 : GL_RGB16F,
                       source.width, source.height);
    if (bytes)
        glTextureSubImage2D(texture.id(), 0, 0, 0, source.width, source.height, GL_RGBA,
                            GL_UNSIGNED_BYTE, source.srgb8.data());
    else
        glTextureSubImage2D(texture.id(), 0, 0, 0, source.width, source.height, GL_RGB, GL_FLOAT,
                            source.linear.data());
    glGenerateTextureMipmap(texture.id());
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, wrapOf(source.wrapU));
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, wrapOf(source.wrapV));
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    return texture;
}

TextureObject makeWhite() {
    TextureObject texture = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, GL_RGBA8, 1, 1);
    const std::uint32_t white = 0xffffffffu;
    glTextureSubImage2D(texture.id(), 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &white);
    return texture;
}

}  // namespace

SceneTextures::SceneTextures(const Scene& scene) : white_(makeWhite()) {
    for (const vlf::Texture& source : scene.textures) textures_.push_back(upload(source));
}

void SceneTextures::bind(int unit, int texture) const {
    const TextureObject& bound =
        texture < 0 ? white_ : textures_[static_cast<std::size_t>(texture)];
    glBindTextureUnit(static_cast<GLuint>(unit), bound.id());
}

}  // namespace vlf::gl
