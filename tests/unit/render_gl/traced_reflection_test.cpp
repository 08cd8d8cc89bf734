// Mode raytraced of the OpenGL renderer shows what the CPU's does.

#include "open_gl.h"
#include "small_rooms.h"
#include "vlf/base/error.h"
#include "vlf/math/random.h"
#include "vlf/render/cpu/camera_rays.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

StillParams tracedStill(const Camera& camera) {
    StillParams params = stillOf(camera);
    params.mode = DisplayMode::raytraced;
    return params;
}

Image drawn(Renderer& renderer, const StillParams& params) {
    Progress progress;
    return renderStill(renderer, params, progress);
}

/// The mirror room with each kind of texture and wrapping on its walls, lamp and mirror.
Scene texturedMirrorRoom() {
    Scene scene = mirrorRoom().scene;
    RandomStream random(3, 1);
    Texture linear{"linear", 5, 3, {}, {}, Wrap::mirror, Wrap::clamp};
    for (int i = 0; i < 15; ++i) linear.linear.emplace_back(random.next2(), random.next());
    Texture bytes{"bytes", 4, 4, {}, {}, Wrap::repeat, Wrap::mirror};
    for (int i = 0; i < 64; ++i)
        bytes.srgb8.push_back(static_cast<std::uint8_t>(255 * random.next()));
    scene.textures = {linear, bytes};
    int next = 0;
    for (Material& m : scene.materials) {
        m.diffuseTexture = next++ % 2;
        if (m.isMirror()) m.mirrorTexture = 1;
        if (m.isEmitter()) m.emissionTexture = 0;
    }
    for (std::size_t v = 0; v < scene.uvs.size(); ++v) {
        const Vec3& p = scene.positions[v];
        scene.uvs[v] = {0.9f * p.x + 0.4f * p.y - 1, 0.7f * p.z - p.y};
    }
    return scene;
}

}  // namespace

TEST_F(OpenGl, TracesReflectionsAsTheCpuDoes) {
    for (const char* camera : {"mirror", "front", "overview"})
        EXPECT_LT(flipAgainstCpu(mirrorRoom(), tracedStill(mirrorRoom().camera(camera))), 0.01)
            << camera;
    // Curved mirrors, in which rays are reflected several times.
    const BakedExample caustic = smallRoom("caustic");
    EXPECT_LT(flipAgainstCpu(caustic, tracedStill(caustic.camera("patch"))), 0.01);
    const BakedExample grotto = smallRoom("grotto");
    EXPECT_LT(flipAgainstCpu(grotto, tracedStill(grotto.camera("pool"))), 0.01);
}

TEST_F(OpenGl, TracesReflectionsOfTexturesAsTheCpuDoes) {
    const Scene scene = texturedMirrorRoom();
    const BakedExample& room = mirrorRoom();
    StillParams params = tracedStill(room.camera("mirror"));
    params.antialias = 1;
    Progress progress;
    Renderer renderer(scene, room.field);
    const Image picture = drawn(renderer, params);
    const Image expected = renderStill(scene, room.rays, room.field, params, progress);
    const CameraRays rays(params.camera, params.width, params.height);
    int mirrored = 0, different = 0;
    for (int y = 0; y < params.height; ++y)
        for (int x = 0; x < params.width; ++x) {
            const Hit hit = room.rays.closest(rays.ray(x + 0.5f, y + 0.5f));
            if (!hit || !scene.material(hit.triangle).isMirror()) continue;
            ++mirrored;
            const Vec3 difference = glm::abs(picture.at(x, y) - expected.at(x, y));
            if (maxComponent(difference) > 0.02f * maxComponent(expected.at(x, y)) + 1e-3f)
                ++different;
        }
    EXPECT_GT(mirrored, 5000);
    EXPECT_LT(different, mirrored / 100) << "but for edges";
}

TEST_F(OpenGl, TracesReflectionsWithoutRadianceOfMirrors) {
    const BakedExample& room = mirrorRoom();
    LightField without = room.field;
    without.radiance = {};
    Renderer renderer(room.scene, without), with(room.scene, room.field);
    EXPECT_FALSE(renderer.canLookUp());
    EXPECT_TRUE(with.canLookUp());
    StillParams params = tracedStill(room.camera("mirror"));
    EXPECT_EQ(drawn(renderer, params).pixels, drawn(with, params).pixels);
    params.mode = DisplayMode::field;
    try {
        drawn(renderer, params);
        FAIL() << "there is nothing to look up";
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("raytraced"), std::string::npos) << e.what();
    }
}

TEST_F(OpenGl, ReflectsNewLight) {
    const BakedExample& room = mirrorRoom();
    Renderer renderer(room.scene, room.field);
    IrradianceAtlas dark = room.field.atlas;
    for (Vec3& e : dark.irradiance) e *= 0.5f;
    const StillParams params = tracedStill(room.camera("mirror"));
    const Image before = drawn(renderer, params);
    EXPECT_EQ(renderer.lightChanges(), 0u);
    renderer.updateIrradiance(dark);
    EXPECT_EQ(renderer.lightChanges(), 1u);
    const Vec3 wallInMirror = before.at(33, 50);
    EXPECT_GT(luminance(wallInMirror), 0);
    EXPECT_NEAR(luminance(drawn(renderer, params).at(33, 50)) / luminance(wallInMirror), 0.5f,
                5e-3f);
}

TEST_F(OpenGl, TracingLeavesTheStateOfItsHostAsItWas) {
    const BakedExample& room = mirrorRoom();
    Renderer renderer(room.scene, room.field);
    const Target target(64, 48);
    disturbState(target);
    const auto before = state();
    RenderSettings settings;
    settings.mode = DisplayMode::raytraced;
    renderer.draw(viewOf(room.camera("mirror"), 64, 48, renderer.nearest()), settings,
                  target.framebuffer.id());
    EXPECT_EQ(state(), before);
}

}  // namespace vlf::test
