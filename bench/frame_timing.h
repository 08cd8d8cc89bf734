#pragma once
// Timing single frames of the OpenGL renderer, for the tables of this folder.

#include "vlf/io/field_file.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/renderer.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

namespace vlf::bench {

/// A picture in 8 bits, as a window has.
struct Target {
    gl::TextureObject color = gl::makeTexture(GL_TEXTURE_2D);
    gl::TextureObject depth = gl::makeTexture(GL_TEXTURE_2D);
    gl::Framebuffer framebuffer = gl::makeFramebuffer();

    Target(int width, int height) {
        glTextureStorage2D(color.id(), 1, GL_RGBA8, width, height);
        glTextureStorage2D(depth.id(), 1, GL_DEPTH_COMPONENT24, width, height);
        glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
        glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
    }
};

/// Mirrors become diffuse surfaces, as the atlas has them.
inline BakedRoom withoutMirrors(BakedRoom room) {
    for (Material& material : room.scene.materials) material.mirror = Vec3(0);
    room.field.radiance = {};
    return room;
}

inline double percentile(std::vector<double> values, double part) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

/// Milliseconds until the frame is done.
inline double frameTime(Renderer& renderer, const View& view, const RenderSettings& settings,
                        const Target& target) {
    const auto start = std::chrono::steady_clock::now();
    renderer.draw(view, settings, target.framebuffer.id());
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

}  // namespace vlf::bench
