#include "vlf/render/gl/still.h"

#include "vlf/base/error.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/supersample.h"
#include "vlf/render/drawing/direction_ball.h"
#include "vlf/render/gl/float_target.h"

#include <algorithm>
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

RenderSettings settingsOf(const StillParams& params) {
    RenderSettings settings;
    settings.mode = params.mode == DisplayMode::progressive ? DisplayMode::raytraced : params.mode;
    settings.lookup = params.lookup;
    settings.tone.reset();
    settings.textureBias = -std::log2(static_cast<float>(params.antialias));
    settings.normals = params.normals;
    settings.diagram = params.diagram;
    settings.diagramRoom = DisplayMode::raytraced;
    settings.diagramCamera = params.camera;
    return settings;
}

/// Of the room beneath a diagram, by a small picture of it, as on the CPU (render/cpu/diagram.cpp).
float exposureOf(Renderer& renderer, const StillParams& params) {
    StillParams preview = params;
    preview.mode = DisplayMode::raytraced;
    preview.width = std::max(params.width / 8, 1);
    preview.height = std::max(params.height / 8, 1);
    preview.antialias = 1;
    const FloatTarget target(preview.width, preview.height);
    renderer.draw(viewOf(preview.camera, preview.width, preview.height, renderer.nearest()),
                  settingsOf(preview), target.framebuffer.id());
    Image image(preview.width, preview.height);
    addTo(image, target, 1);
    return autoExposure(image);
}

/// A ball before the camera that nothing is nearer than.
Sphere nearestBall(const Renderer& renderer, const StillParams& params) {
    const float sine = ballBefore(params.camera, params.width, params.height, 1).radius;
    return ballBefore(params.camera, params.width, params.height,
                      2 * renderer.nearest() / (1 - sine));
}

void prepareDiagram(Renderer& renderer, const StillParams& params, RenderSettings& settings,
                    Camera& camera) {
    camera = renderer.diagramView(params.diagram, params.camera, params.width, params.height);
    settings.exposure = exposureOf(renderer, params);
    settings.ball = nearestBall(renderer, params);
}

/// How many pictures a side are averaged: drawings of lines alone are smooth in one.
int picturesAlongSide(const StillParams& params) {
    const bool lines =
        params.mode == DisplayMode::wireframe ||
        (params.mode == DisplayMode::diagram && params.diagram.kind == DiagramKind::subfield);
    return lines ? 1 : params.antialias;
}

}  // namespace

Image renderStill(Renderer& renderer, const StillParams& params, Progress& progress,
                  StillReport* report) {
    using Clock = std::chrono::steady_clock;
    requireDrawable(params);
    const Clock::time_point start = Clock::now();
    progress.stage("rendering");
    if (params.objects) renderer.updateObjects(*params.objects);
    const int n = picturesAlongSide(params);
    const FloatTarget target(params.width, params.height);
    RenderSettings settings = settingsOf(params);
    Camera camera = params.camera;
    if (params.mode == DisplayMode::diagram) prepareDiagram(renderer, params, settings, camera);
    const View view = viewOf(camera, params.width, params.height, renderer.nearest());
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
