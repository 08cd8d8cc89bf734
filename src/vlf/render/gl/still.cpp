#include "vlf/render/gl/still.h"

#include "vlf/base/error.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/gl/gl_object.h"

#include <chrono>
#include <vector>

namespace vlf {

namespace {

using namespace gl;

constexpr int kMaxAntialias = 16;

/// Radiance and depth of a picture.
struct FloatTarget {
    TextureObject color, depth;
    Framebuffer framebuffer = makeFramebuffer();

    FloatTarget(int width, int height) {
        color = image(GL_RGBA32F, width, height);
        depth = image(GL_DEPTH_COMPONENT32F, width, height);
        glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
        glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
    }

    static TextureObject image(GLenum format, int width, int height) {
        TextureObject texture = makeTexture(GL_TEXTURE_2D);
        glTextureStorage2D(texture.id(), 1, format, width, height);
        return texture;
    }

    /// Adds a part of the picture to an image, whose first row is the top.
    void addTo(Image& sum, float weight) {
        pixels_.resize(sum.pixels.size());
        glGetTextureImage(color.id(), 0, GL_RGB, GL_FLOAT,
                          static_cast<GLsizei>(pixels_.size() * sizeof(Vec3)), pixels_.data());
        for (int y = 0; y < sum.height; ++y)
            for (int x = 0; x < sum.width; ++x)
                sum.at(x, y) +=
                    weight * pixels_[static_cast<std::size_t>(sum.height - 1 - y) * sum.width + x];
    }

  private:
    std::vector<Vec3> pixels_;
};

void requireDrawable(const StillParams& params) {
    const CameraRays requireView(params.camera, params.width, params.height);
    if (params.antialias < 1 || params.antialias > kMaxAntialias)
        throw InputError("antialias must lie between 1 and " + std::to_string(kMaxAntialias) +
                         " rays along a pixel's side");
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (params.width > most || params.height > most)
        throw InputError("a picture by OpenGL has at most " + std::to_string(most) +
                         " pixels along a side; choose a smaller --size or --backend cpu");
}

}  // namespace

Image renderStill(Renderer& renderer, const StillParams& params, Progress& progress,
                  StillReport* report) {
    using Clock = std::chrono::steady_clock;
    requireDrawable(params);
    const Clock::time_point start = Clock::now();
    progress.stage("rendering");
    const int n = params.antialias;
    FloatTarget target(params.width, params.height);
    RenderSettings settings;
    settings.mode = params.mode == DisplayMode::progressive ? DisplayMode::raytraced : params.mode;
    settings.lookup = params.lookup;
    settings.tone.reset();
    settings.textureBias = -std::log2(static_cast<float>(n));
    const View view = viewOf(params.camera, params.width, params.height, renderer.nearest());
    Image image(params.width, params.height);
    for (int i = 0; i < n * n; ++i) {
        progress.check();
        // The same points of a pixel as render/cpu/supersample.cpp.
        const auto column = static_cast<float>(i % n), row = static_cast<float>(i / n);
        const auto side = static_cast<float>(n);
        const Vec2 point((column + (row + 0.5f) / side) / side,
                         (row + (column + 0.5f) / side) / side);
        renderer.draw(shifted(view, point - 0.5f), settings, target.framebuffer.id());
        target.addTo(image, 1.0f / static_cast<float>(n * n));
        progress.update(static_cast<double>(i + 1) / (n * n));
    }
    if (report) *report = {std::chrono::duration<double>(Clock::now() - start).count(), 0};
    return image;
}

}  // namespace vlf
