#include "vlf/render/gl/picture_texture.h"

#include "vlf/image/srgb.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf::gl {

void PictureTexture::set(const Image& image) {
    std::vector<std::array<std::uint8_t, 4>> texels;
    texels.reserve(image.pixels.size());
    for (const Vec3& p : image.pixels)
        texels.push_back({srgb8FromLinear(p.x), srgb8FromLinear(p.y), srgb8FromLinear(p.z), 255});
    texture_ = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture_.id(), 1, GL_RGBA8, image.width, image.height);
    glTextureSubImage2D(texture_.id(), 0, 0, 0, image.width, image.height, GL_RGBA,
                        GL_UNSIGNED_BYTE, texels.data());
    glTextureParameteri(texture_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture_.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

}  // namespace vlf::gl
