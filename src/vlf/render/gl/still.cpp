#include "vlf/render/gl/still.h"

#include "vlf/base/error.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/supersample.h"
#include "vlf/render/gl/float_target.h"

#include <chrono>
#include <vector>

namespace vlf {

namespace {

using namespace gl;

constexpr int kMaxAntialias = 16;

/// Adds a part of the picture to an image, whose first row is the top.
void addTo(Image& sum, const FloatTarget& picture, float weight) {
    std::vector<Vec3> pixels(sum.pixels.size());
    glGetTextureImage(picture.color.id(), 0, GL_RGB, GL_FLOAT,
                      static_cast<GLsizei>(pixels.size() * sizeof(Vec3)), pixels.data());
    for (int y = 0; y < sum.height; ++y)
        for (int x = 0; x < sum.width; ++x)
            sum.at(x, y) +=
                weight * pixels[static_cast<std::size_t>(sum.height - 1 - y) * sum.width + x];
}

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
    const FloatTarget target(params.width, params.height);
    RenderSettings settings;
    settings.mode = params.mode == DisplayMode::progressive ? DisplayMode::raytraced : params.mode;
    settings.lookup = params.lookup;
    settings.tone.reset();
    settings.textureBias = -std::log2(static_cast<float>(n));
    const View view = viewOf(params.camera, params.width, params.height, renderer.nearest());
    Image image(params.width, params.height);
    for (int i = 0; i < n * n; ++i) {
        progress.check();
        renderer.draw(shifted(view, samplePoint(i, n) - 0.5f), settings, target.framebuffer.id());
        addTo(image, target, 1.0f / static_cast<float>(n * n));
        progress.update(static_cast<double>(i + 1) / (n * n));
    }
    if (report) *report = {std::chrono::duration<double>(Clock::now() - start).count(), 0};
    return image;
}

}  // namespace vlf
