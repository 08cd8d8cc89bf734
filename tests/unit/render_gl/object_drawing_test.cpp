// Objects drawn by OpenGL are what rays find.

#include "dynamic_example.h"
#include "support/analytic_scenes.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/projection.h"
#include "vlf/render/gl/progressive.h"
#include "vlf/render/gl/read_framebuffer.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

const BakedExample& cornell() {
    static const BakedExample room = smallRoom("cornell");
    return room;
}

/// Two turned triangles of different materials that are seen from both sides.
Scene openScene() {
    SceneBuilder b;
    const std::uint32_t red = b.material("red", {0.7f, 0.1f, 0.1f});
    const std::uint32_t blue = b.material("blue", {0.1f, 0.1f, 0.7f});
    b.quad({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}, red);
    b.quad({0.5f, -0.5f, 0}, {0, 0, 1}, {0, 1, 0}, blue);
    return b.scene();
}

}  // namespace

TEST_F(OpenGl, DrawsObjectsAsRaysFindThem) {
    DynamicRoom dynamic(cornell().scene, cornell().rays, cornell().field);
    dynamic.add(objectOf("knot", {1.8f, 3.2f, 1.5f}, 1.4f));
    dynamic.add(objectOf("cube", {3.8f, 1.5f, 0.9f}, 1.0f));
    Pose pose = dynamic.object(1).pose;
    pose.rotation = glm::angleAxis(0.6f, glm::normalize(Vec3(1, 2, 0)));
    dynamic.setPose(1, pose);
    dynamic.update();
    StillParams params = stillOf(cornell().camera("front"));
    EXPECT_LT(flipAgainstCpu(cornell(), dynamic, params), 0.012);
    params.mode = DisplayMode::raytraced;
    EXPECT_LT(flipAgainstCpu(cornell(), dynamic, params), 0.012);
}

TEST_F(OpenGl, DrawsObjectsThatAreLitByTexelAndTheirShadows) {
    DynamicRoom dynamic(cornell().scene, cornell().rays, cornell().field);
    DynamicObject cube = objectOf("cube", {3.8f, 0.9f, 0.9f}, 1.0f);
    cube.settings = {};
    dynamic.add(cube);
    cube.pose.translation = {1.2f, 4.0f, 1.5f};
    cube.pose.scale = 0.7f;
    dynamic.add(cube);
    dynamic.update();
    ASSERT_TRUE(dynamic.litObjects()[0].texels);
    const StillParams params = stillOf(cornell().camera("front"));
    EXPECT_LT(flipAgainstCpu(cornell(), dynamic, params), 0.012);
    cube.pose.translation = {4.4f, 0.6f, 1.5f};
    dynamic.setPose(0, cube.pose);
    dynamic.update();
    EXPECT_LT(flipAgainstCpu(cornell(), dynamic, params), 0.012);
}

TEST_F(OpenGl, DrawsBothSidesOfOpenObjects) {
    DynamicRoom dynamic(cornell().scene, cornell().rays, cornell().field);
    const auto model = std::make_shared<const ObjectModel>(openScene());
    dynamic.add(objectOf(model, {1.8f, 3.0f, 1.0f}, 1.4f));
    dynamic.add(objectOf(model, {3.8f, 3.0f, 1.0f}, 1.4f));
    Pose pose = dynamic.object(1).pose;
    pose.rotation = glm::angleAxis(2.8f, Vec3(0, 1, 0));
    dynamic.setPose(1, pose);
    dynamic.update();
    EXPECT_LT(flipAgainstCpu(cornell(), dynamic, stillOf(cornell().camera("front"))), 0.012);
}

TEST_F(OpenGl, MirrorsShowObjectsInBothModes) {
    const BakedExample& room = mirrorRoom();
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    dynamic.add(objectOf("sphere", {2.9f, 1.8f, 1.4f}, 0.8f));
    dynamic.add(objectOf("cube", {3.5f, 2.6f, 0.6f}, 0.5f));
    dynamic.update();
    for (const DisplayMode mode : {DisplayMode::raytraced, DisplayMode::field})
        for (const char* camera : {"mirror", "front"}) {
            StillParams params = stillOf(room.camera(camera));
            params.mode = mode;
            EXPECT_LT(flipAgainstCpu(room, dynamic, params),
                      mode == DisplayMode::raytraced ? 0.012 : 0.025)
                << camera;
        }
}

TEST_F(OpenGl, MirrorsShowShadowsOfObjectsInBothModes) {
    const BakedExample& room = mirrorRoom();
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    DynamicObject cube = objectOf("cube", {3.0f, 0.6f, 3.6f}, 1.0f);
    cube.settings = {};
    dynamic.add(cube);
    dynamic.update();
    for (const DisplayMode mode : {DisplayMode::raytraced, DisplayMode::field}) {
        StillParams params = stillOf(room.camera("front"));
        params.mode = mode;
        EXPECT_LT(flipAgainstCpu(room, dynamic, params),
                  mode == DisplayMode::raytraced ? 0.012 : 0.025);
    }
}

TEST_F(OpenGl, MirrorObjectsReflectRoomAndObjectsInBothModes) {
    const BakedExample& room = mirrorRoom();
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    Material mixed = matte({0.2f, 0.2f, 0.3f});
    mixed.mirror = Vec3(0.6f);
    dynamic.add(objectOf("sphere", {2.6f, 1.9f, 2.0f}, 1.2f, mixed));
    dynamic.add(objectOf("cube", {3.6f, 1.9f, 2.4f}, 0.5f));
    dynamic.add(objectOf("cube", {1.6f, 2.6f, 1.6f}, 0.4f, mixed));
    dynamic.update();
    for (const DisplayMode mode : {DisplayMode::raytraced, DisplayMode::field})
        for (const char* camera : {"mirror", "front"}) {
            StillParams params = stillOf(room.camera(camera));
            params.mode = mode;
            EXPECT_LT(flipAgainstCpu(room, dynamic, params),
                      mode == DisplayMode::raytraced ? 0.015 : 0.03)
                << camera;
        }
}

// Pixel by pixel: where a ray reflected once meets the object, it is seen in the mirror.
TEST_F(OpenGl, MirrorsShowObjectsAtTheRightPixels) {
    const BakedExample& room = mirrorRoom();
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    Material glow = matte(Vec3(0));
    glow.emission = {100, 0, 0};
    dynamic.add(objectOf("knot", {2.6f, 1.8f, 1.7f}, 1.4f, glow));
    dynamic.update();
    Renderer renderer(room.scene, room.field);
    renderer.updateObjects(dynamic);
    for (const auto& [mode, lookup] :
         {std::pair{DisplayMode::raytraced, LookupKind::depthCorrected},
          {DisplayMode::field, LookupKind::depthCorrected},
          {DisplayMode::field, LookupKind::plain}}) {
        StillParams params = stillOf(room.camera("mirror"), lookup);
        params.mode = mode;
        params.antialias = 1;
        const Image image = drawn(renderer, params);
        const CameraRays camera(params.camera, params.width, params.height);
        int mirrored = 0, direct = 0, wrong = 0;
        for (int y = 0; y < params.height; ++y)
            for (int x = 0; x < params.width; ++x) {
                const Ray ray = camera.ray(x + 0.5f, y + 0.5f);
                const bool reflected = meetsObject(dynamic, room.rays, ray, 1);
                const bool seen = meetsObject(dynamic, room.rays, ray, 0);
                mirrored += reflected, direct += seen;
                wrong += (image.at(x, y).x > 40) != (reflected || seen);
            }
        EXPECT_GT(mirrored, 200);
        EXPECT_GT(direct, 200);
        EXPECT_LT(wrong, (mirrored + direct) / 50) << static_cast<int>(lookup);
    }
}

TEST_F(OpenGl, HidesObjectsBehindWhatIsNearerInMirrorsToo) {
    const BakedExample& room = mirrorRoom();
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    Material glow = matte(Vec3(0));
    glow.emission = {100, 0, 0};
    dynamic.add(objectOf("sphere", {1.9f, 0.4f, 2.3f}, 0.15f, glow));  // within the plinth
    dynamic.update();
    Renderer renderer(room.scene, room.field);
    renderer.updateObjects(dynamic);
    for (const DisplayMode mode : {DisplayMode::raytraced, DisplayMode::field})
        for (const char* camera : {"mirror", "overview", "front"}) {
            StillParams params = stillOf(room.camera(camera));
            params.mode = mode;
            const Image image = drawn(renderer, params);
            const auto bright =
                std::count_if(image.pixels.begin(), image.pixels.end(),
                              [](const Vec3& p) { return p.x > 3 && p.y < 0.1f * p.x; });
            EXPECT_EQ(bright, 0) << camera;
        }
}

TEST_F(OpenGl, DrawsEdgesOfObjectsInWireframes) {
    DynamicRoom dynamic(cornell().scene, cornell().rays, cornell().field);
    Renderer renderer(cornell().scene, cornell().field);
    StillParams params = stillOf(cornell().camera("front"));
    params.mode = DisplayMode::wireframe;
    const Image without = drawn(renderer, params);
    dynamic.add(objectOf("cube", {2.0f, 2.5f, 0.8f}, 1.0f));
    dynamic.update();
    renderer.updateObjects(dynamic);
    const Image with = drawn(renderer, params);
    const Projection projection(params.camera, params.width, params.height);
    const Vec2 corner = projection.project(Vec3(2.5f, 3.0f, 0.3f))->position;
    const auto darkest = [&](const Image& image) {
        float least = 1;
        for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x)
                least = std::min(least, luminance(image.at(static_cast<int>(corner.x) + x,
                                                           static_cast<int>(corner.y) + y)));
        return least;
    };
    EXPECT_GT(darkest(without), 2 * darkest(with));
}

TEST_F(OpenGl, ObjectsOfAMeshShareItsBuffers) {
    DynamicRoom dynamic(cornell().scene, cornell().rays, cornell().field);
    Renderer renderer(cornell().scene, cornell().field);
    const int before = gl::liveObjects();
    const auto model =
        std::make_shared<const ObjectModel>(makePrimitive("knot", matte(Vec3(0.5f))));
    dynamic.add(objectOf(model, {0.3f, 0.3f, 0.3f}, 0.2f));
    dynamic.update();
    renderer.updateObjects(dynamic);
    const int one = gl::liveObjects();
    for (int i = 1; i < 50; ++i) dynamic.add(objectOf(model, {0.3f + 0.02f * i, 0.3f, 0.3f}, 0.2f));
    dynamic.update();
    renderer.updateObjects(dynamic);
    EXPECT_EQ(gl::liveObjects(), one);
    for (int i = 0; i < 50; ++i) dynamic.remove(0);
    dynamic.update();
    renderer.updateObjects(dynamic);
    EXPECT_LE(gl::liveObjects(), before + 1) << "buffers of records may stay";
}

TEST_F(OpenGl, ProgressivePicturesBeginAnewWhenObjectsMove) {
    const BakedExample& room = mirrorRoom();
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    dynamic.add(objectOf("cube", {2.9f, 1.8f, 1.4f}, 0.6f));
    dynamic.update();
    Renderer renderer(room.scene, room.field);
    renderer.updateObjects(dynamic);
    ProgressiveRenderer progressive(renderer);
    const Target target(48, 36);
    const View view = viewOf(room.camera("mirror"), 48, 36, renderer.nearest());
    const auto draw = [&] { progressive.draw(view, {}, target.framebuffer.id(), 1); };
    for (int i = 0; i < 10 && progressive.samples() == 0; ++i) draw();
    EXPECT_GT(progressive.samples(), 0);
    Pose pose = dynamic.object(0).pose;
    pose.translation.x += 0.2f;
    dynamic.setPose(0, pose);
    dynamic.update();
    renderer.updateObjects(dynamic);
    draw();
    EXPECT_EQ(progressive.samples(), 0);
    const Image moving = readFramebuffer(target.framebuffer.id(), 48, 36);
    const Target field(48, 36);
    renderer.draw(view, {}, field.framebuffer.id());
    EXPECT_EQ(moving.pixels, readFramebuffer(field.framebuffer.id(), 48, 36).pixels);
    for (int i = 0; i < 10 && progressive.samples() == 0; ++i) draw();
    EXPECT_GT(progressive.samples(), 0) << "at rest it is refined";
}

TEST_F(OpenGl, MovingObjectsCountAsNewLight) {
    DynamicRoom dynamic(cornell().scene, cornell().rays, cornell().field);
    dynamic.add(objectOf("cube", {1, 1, 1}, 0.3f));
    dynamic.update();
    Renderer renderer(cornell().scene, cornell().field);
    renderer.updateObjects(dynamic);
    const std::uint64_t before = renderer.lightChanges();
    Pose pose = dynamic.object(0).pose;
    pose.translation.x += 0.1f;
    dynamic.setPose(0, pose);
    dynamic.update();
    renderer.updateObjects(dynamic);
    EXPECT_GT(renderer.lightChanges(), before);
}

TEST_F(OpenGl, DrawingObjectsLeavesTheStateOfItsHostAsItWas) {
    const BakedExample& room = mirrorRoom();
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    dynamic.add(objectOf("sphere", {2.9f, 1.8f, 1.4f}, 0.8f));
    dynamic.update();
    Renderer renderer(room.scene, room.field);
    const Target target(64, 48);
    disturbState(target);
    const auto before = state();
    renderer.updateObjects(dynamic);
    EXPECT_EQ(state(), before);
    for (const DisplayMode mode :
         {DisplayMode::field, DisplayMode::raytraced, DisplayMode::wireframe}) {
        RenderSettings settings;
        settings.mode = mode;
        renderer.draw(viewOf(room.camera("mirror"), 64, 48, renderer.nearest()), settings,
                      target.framebuffer.id());
        EXPECT_EQ(state(), before);
    }
}

}  // namespace vlf::test
