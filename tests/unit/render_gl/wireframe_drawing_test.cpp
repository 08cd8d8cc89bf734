// Mode wireframe by OpenGL.

#include "open_gl.h"
#include "small_rooms.h"
#include "support/analytic_scenes.h"
#include "vlf/image/srgb.h"
#include "vlf/render/cpu/projection.h"
#include "vlf/render/drawing/pen.h"
#include "vlf/render/gl/read_framebuffer.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

StillParams wireframeOf(const Camera& camera) {
    StillParams params = stillOf(camera);
    params.mode = DisplayMode::wireframe;
    return params;
}

Image draw(const Scene& scene, const LightField& field, const StillParams& params) {
    Progress progress;
    Renderer renderer(scene, field);
    return renderStill(renderer, params, progress);
}

/// Sides without charts: the drawing shows triangles, not light.
LightField unlit(const Scene& scene) {
    LightField field;
    field.triangleCharts.resize(scene.triangles.size());
    const Sphere sphere = boundingSphere(scene);
    field.frame = {sphere.centre, sphere.radius};
    return field;
}

}  // namespace

// Lines end up to a stroke of two pixels earlier or later: a pixel's depth stands for a ray.
TEST_F(OpenGl, DrawsWireframesAsTheCpuDoes) {
    const BakedExample cornell = smallRoom("cornell");
    for (const auto& [room, camera] :
         {std::pair{&cornell, "corner"}, {&mirrorRoom(), "statue"}, {&mirrorRoom(), "front"}}) {
        StillParams params = wireframeOf(room->camera(camera));
        params.width = 320;
        params.height = 240;
        for (const bool normals : {false, true}) {
            params.normals = normals;
            Progress progress;
            const Image reference =
                renderStill(room->scene, room->rays, room->field, params, progress);
            EXPECT_LT(flip(draw(room->scene, room->field, params), reference).mean, 0.015)
                << camera << (normals ? ", normals" : "");
        }
    }
}

/// A square far behind a larger one, seen frontally.
TEST_F(OpenGl, HiddenLinesAreFaint) {
    SceneBuilder b;
    const std::uint32_t grey = b.material("grey", Vec3(0.5f));
    b.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, grey);
    b.quad({-0.5f, -0.5f, -1}, {1, 0, 0}, {0, 1, 0}, grey);
    b.camera("front", {0, 0, 3}, {0, 0, 0}, 50);
    const Camera& camera = b.scene().cameras.front();
    StillParams params = wireframeOf(camera);
    params.width = params.height = 200;
    const Image image = draw(b.scene(), unlit(b.scene()), params);
    const Projection projection(camera, 200, 200);
    const auto darkestNear = [&](const Vec3& p) {
        const Vec2 at = projection.project(p)->position;
        float darkest = 1;
        for (int y = static_cast<int>(at.y) - 2; y <= static_cast<int>(at.y) + 2; ++y)
            for (int x = static_cast<int>(at.x) - 2; x <= static_cast<int>(at.x) + 2; ++x)
                darkest = std::min(darkest, luminance(image.at(x, y)));
        return darkest;
    };
    const float paper = luminance(kPaper);
    EXPECT_LT(darkestNear({1, 0.4f, 0}), 0.4f * paper);
    EXPECT_GT(darkestNear({0.5f, 0.2f, -1}), 0.8f * paper);
    EXPECT_LT(darkestNear({0.5f, 0.2f, -1}), 0.99f * paper);
    EXPECT_EQ(darkestNear({0.7f, 0.8f, 0}), paper);
}

TEST_F(OpenGl, DrawsNormalsOnDemand) {
    const BakedExample room = smallRoom("cornell");
    StillParams params = wireframeOf(room.camera("front"));
    const auto orange = [&] {
        const Image image = draw(room.scene, room.field, params);
        return std::count_if(image.pixels.begin(), image.pixels.end(),
                             [](const Vec3& p) { return p.x > 2 * p.z; });
    };
    EXPECT_EQ(orange(), 0);
    params.normals = true;
    EXPECT_GT(orange(), 30);
}

TEST_F(OpenGl, LinesAreSmoothInOnePicture) {
    StillParams params = wireframeOf(mirrorRoom().camera("front"));
    params.antialias = 1;
    const Image once = draw(mirrorRoom().scene, mirrorRoom().field, params);
    params.antialias = 4;
    EXPECT_EQ(once.pixels, draw(mirrorRoom().scene, mirrorRoom().field, params).pixels);
}

TEST_F(OpenGl, DrawsIntoTheViewsRectangleAlone) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    const Camera& camera = mirrorRoom().camera("front");
    RenderSettings settings;
    settings.mode = DisplayMode::wireframe;
    const Target whole(80, 60), part(120, 90);
    View view = viewOf(camera, 80, 60, renderer.nearest());
    renderer.draw(view, settings, whole.framebuffer.id());
    const float black[4] = {0, 0, 0, 0};
    glClearTexImage(part.color.id(), 0, GL_RGBA, GL_FLOAT, black);
    view.x = 30;
    view.y = 20;
    renderer.draw(view, settings, part.framebuffer.id());
    const Image expected = readFramebuffer(whole.framebuffer.id(), 80, 60);
    const Image image = readFramebuffer(part.framebuffer.id(), 120, 90);
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 120; ++x) {
            const int column = x - 30, row = y - 10;
            const bool inside = column >= 0 && column < 80 && row >= 0 && row < 60;
            ASSERT_EQ(image.at(x, y), inside ? expected.at(column, row) : Vec3(0)) << x << " " << y;
        }
}

TEST_F(OpenGl, EncodesDrawingsForTheDisplay) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    const StillParams params = wireframeOf(mirrorRoom().camera("front"));
    Progress progress;
    const Image linear = renderStill(renderer, params, progress);
    const Target target(params.width, params.height);
    RenderSettings settings;
    settings.mode = DisplayMode::wireframe;
    settings.exposure = 3;  // has no effect
    renderer.draw(viewOf(params.camera, params.width, params.height, renderer.nearest()), settings,
                  target.framebuffer.id());
    const Image shown = readFramebuffer(target.framebuffer.id(), params.width, params.height);
    float largest = 0;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i)
        largest = std::max(largest, maxComponent(glm::abs(srgbFromLinear(shown.pixels[i]) -
                                                          srgbFromLinear(linear.pixels[i]))));
    EXPECT_LT(largest, 1.5f / 255);
}

}  // namespace vlf::test
