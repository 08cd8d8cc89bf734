#include "vlf/render/gl/read_framebuffer.h"

#include "vlf/image/srgb.h"

#include <cstdint>
#include <vector>

#include <epoxy/gl.h>

namespace vlf {

Image readFramebuffer(unsigned framebuffer, int width, int height) {
    std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(width) * height);
    GLint bound = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    // Four bytes a pixel fit every row alignment.
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::uint8_t* p =
                &bytes[4 * (static_cast<std::size_t>(height - 1 - y) * width + x)];
            image.at(x, y) =
                Vec3(linearFromSrgb8(p[0]), linearFromSrgb8(p[1]), linearFromSrgb8(p[2]));
        }
    return image;
}

}  // namespace vlf
