#include "vlf/render/gl/renderer.h"

#include "open_gl.h"
#include "small_rooms.h"
#include "vlf/base/error.h"
#include "vlf/image/srgb.h"
#include "vlf/render/gl/gpu_memory.h"
#include "vlf/render/gl/read_framebuffer.h"

#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {

TEST_F(OpenGl, DrawsDiffuseRoomsAsTheCpuDoes) {
    for (const auto& [name, camera] : {std::pair{"cornell", "front"}, {"two-rooms", "door"}}) {
        const BakedExample room = smallRoom(name);
        EXPECT_LT(flipAgainstCpu(room, stillOf(room.camera(camera))), 0.01) << name;
    }
}

TEST_F(OpenGl, DrawsShiftedPicturesAsTheCpuDoes) {
    const BakedExample room = smallRoom("cornell");
    StillParams params = stillOf(room.camera("front"));
    params.camera.shift = {0.3f, -0.2f};
    EXPECT_LT(flipAgainstCpu(room, params), 0.01);
}

TEST_F(OpenGl, DrawsTexturesAsTheCpuDoes) {
    const BakedExample room = smallRoom("office");
    EXPECT_LT(flipAgainstCpu(room, stillOf(room.camera("overview"))), 0.02);
}

// Elements of four bytes, where the CPU has six.
TEST_F(OpenGl, LooksMirrorsUpPlainAsTheCpuDoes) {
    for (const char* camera : {"mirror", "front"}) {
        const StillParams params = stillOf(mirrorRoom().camera(camera), LookupKind::plain);
        EXPECT_LT(flipAgainstCpu(mirrorRoom(), params), 0.01) << camera;
    }
}

// The CPU searches the line of sight cell by cell, where the shader takes four steps.
TEST_F(OpenGl, LooksMirrorsUpByDepthAsTheCpuDoes) {
    for (const char* camera : {"mirror", "front"})
        EXPECT_LT(flipAgainstCpu(mirrorRoom(), stillOf(mirrorRoom().camera(camera))), 0.02);
}

TEST_F(OpenGl, LooksRoughMirrorsUpAsTheCpuDoes) {
    const BakedExample room = smallRoom("gloss");
    for (const LookupKind lookup : {LookupKind::plain, LookupKind::depthCorrected}) {
        const StillParams params = stillOf(room.camera("front"), lookup);
        EXPECT_LT(flipAgainstCpu(room, params), 0.01);
    }
}

// As in mode `field`; the CPU traces them.
TEST_F(OpenGl, LooksRoughMirrorsUpWherePerfectOnesAreTraced) {
    const BakedExample room = smallRoom("gloss");
    const StillParams lookedUp = stillOf(room.camera("front"));
    StillParams traced = lookedUp;
    traced.mode = DisplayMode::raytraced;
    Progress progress;
    Renderer renderer(room.scene, room.field);
    EXPECT_LT(meanFlip(renderStill(renderer, traced, progress),
                       renderStill(room.scene, room.rays, room.field, lookedUp, progress)),
              0.01);
    EXPECT_LT(flipAgainstCpu(room, traced), 0.04);
}

// Weak rays, which the CPU follows behind the first glass, the shader leaves out: those within the
// ball, which show the lamp, are seen to be missing.
TEST_F(OpenGl, DrawsGlassAsTheCpuDoes) {
    const BakedExample room = smallRoom("glass");
    const auto difference = [&](const char* camera, DisplayMode mode) {
        StillParams params = stillOf(room.camera(camera));
        params.mode = mode;
        return flipAgainstCpu(room, params);
    };
    EXPECT_LT(difference("pane", DisplayMode::field), 0.02);
    EXPECT_LT(difference("pane", DisplayMode::raytraced), 0.02);
    EXPECT_LT(difference("ball", DisplayMode::field), 0.02);
    EXPECT_LT(difference("ball", DisplayMode::raytraced), 0.05);
}

TEST_F(OpenGl, TakesNewLight) {
    const BakedExample room = smallRoom("cornell");
    Renderer renderer(room.scene, room.field);
    IrradianceAtlas dark = room.field.atlas;
    for (Vec3& e : dark.irradiance) e *= 0.5f;
    const StillParams params = stillOf(room.camera("inside"));
    Progress progress;
    const Image before = renderStill(renderer, params, progress);
    renderer.updateIrradiance(dark);
    const Image after = renderStill(renderer, params, progress);
    const Vec3 pixel = before.at(20, 100);
    EXPECT_GT(luminance(pixel), 0);
    EXPECT_NEAR(luminance(after.at(20, 100)) / luminance(pixel), 0.5f, 5e-3f);
}

TEST_F(OpenGl, WritesColoursForTheDisplayAsTheCpuMapsThem) {
    const BakedExample room = smallRoom("cornell");
    Renderer renderer(room.scene, room.field);
    StillParams params = stillOf(room.camera("front"));
    params.antialias = 1;
    Progress progress;
    const Image radiance = renderStill(renderer, params, progress);
    const Target target(params.width, params.height);
    for (const ToneCurve tone : {ToneCurve::filmic, ToneCurve::clamp}) {
        RenderSettings settings;
        settings.tone = tone;
        settings.exposure = 1.5f;
        renderer.draw(viewOf(params.camera, params.width, params.height, renderer.nearest()),
                      settings, target.framebuffer.id());
        const Image shown = readFramebuffer(target.framebuffer.id(), params.width, params.height);
        const Image expected = toneMap(radiance, settings.exposure, tone);
        float largest = 0;
        for (std::size_t i = 0; i < shown.pixels.size(); ++i)
            largest = std::max(largest, maxComponent(glm::abs(srgbFromLinear(shown.pixels[i]) -
                                                              srgbFromLinear(expected.pixels[i]))));
        EXPECT_LT(largest, 1.5f / 255);
    }
}

TEST_F(OpenGl, LeavesTheStateOfItsHostAsItWas) {
    const BakedExample room = smallRoom("cornell");
    Renderer renderer(room.scene, room.field);
    const Target target(64, 48);
    disturbState(target);
    const auto before = state();
    renderer.draw(viewOf(room.camera("front"), 64, 48, 0.01f), {}, target.framebuffer.id());
    EXPECT_EQ(state(), before);
    std::vector<std::uint8_t> pixels(4 * 64 * 48);
    glGetTextureImage(target.color.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(pixels.size()), pixels.data());
    EXPECT_GT(pixels[4 * (24 * 64 + 32)], 20) << "the picture is there all the same";
}

TEST_F(OpenGl, RefusesWhatItCannotDraw) {
    const BakedExample& room = mirrorRoom();
    LightField other = room.field;
    other.triangleCharts.pop_back();
    EXPECT_THROW(Renderer(room.scene, other), InputError);
    Renderer renderer(room.scene, room.field);
    StillParams params = stillOf(room.camera("front"));
    params.antialias = 0;
    Progress progress;
    EXPECT_THROW(renderStill(renderer, params, progress), InputError);
    const Target target(64, 48);
    RenderSettings settings;
    settings.mode = DisplayMode::progressive;
    EXPECT_THROW(
        renderer.draw(viewOf(params.camera, 64, 48, 0.01f), settings, target.framebuffer.id()),
        InputError);
    params = stillOf(room.camera("front"));
    progress.cancel();
    EXPECT_THROW(renderStill(renderer, params, progress), Cancelled);
}

TEST_F(OpenGl, TakesNewShadersAndKeepsTheOldOnesIfTheyAreAtFault) {
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / "vlf_reloaded_shaders";
    std::filesystem::create_directories(folder);
    const auto write = [&](const std::string& text) {
        std::ofstream(folder / "tone_map.glsl") << text;
    };
    write("vec4 outputColor(vec3 radiance) { return vec4(0.25, 0, 0, 1); }\n");
    const BakedExample room = smallRoom("cornell");
    Renderer renderer(room.scene, room.field, {folder.string()});
    Progress progress;
    const StillParams params = stillOf(room.camera("inside"));
    const auto red = [&] { return renderStill(renderer, params, progress).at(80, 60).x; };
    EXPECT_EQ(red(), 0.25f);
    write("vec4 outputColor(vec3 radiance) { return nonsense; }\n");
    EXPECT_THROW(renderer.reloadShaders(), InputError);
    EXPECT_EQ(red(), 0.25f);
    write("vec4 outputColor(vec3 radiance) { return vec4(0.5, 0, 0, 1); }\n");
    renderer.reloadShaders();
    EXPECT_EQ(red(), 0.5f);
    write("nonsense");
    EXPECT_THROW(Renderer(room.scene, room.field, {folder.string()}), InputError);
    std::filesystem::remove_all(folder);
    EXPECT_FALSE(messages_.empty());
    messages_.clear();
}

TEST_F(OpenGl, ShowsMirrorsCoarserWhereMemoryIsShortAndSaysSo) {
    const BakedExample& room = mirrorRoom();
    const Renderer whole(room.scene, room.field);
    EXPECT_TRUE(whole.notices().empty());
    const StillParams params = stillOf(room.camera("mirror"));
    Progress progress;
    RendererOptions options;
    options.maxMemory = whole.memory().total() / 2;
    Renderer renderer(room.scene, room.field, options);
    EXPECT_LE(renderer.memory().total(), whole.memory().total() / 2);
    EXPECT_EQ(renderer.notices().size(), 1u);
    EXPECT_LT(meanFlip(renderStill(renderer, params, progress),
                       renderStill(room.scene, room.rays, room.field, params, progress)),
              0.04);
    options.maxMemory = 1000;
    EXPECT_THROW(Renderer(room.scene, room.field, options), InputError);
}

TEST_F(OpenGl, ShowsMirrorsTheSameWithFourElementsATexelOfASmallBufferTexture) {
    const BakedExample& room = mirrorRoom();
    Renderer whole(room.scene, room.field);
    RendererOptions options;
    options.maxBufferTexels = whole.memory().radianceElements / 2;
    Renderer renderer(room.scene, room.field, options);
    EXPECT_TRUE(renderer.notices().empty());
    const StillParams params = stillOf(room.camera("mirror"));
    Progress progress;
    EXPECT_EQ(
        meanFlip(renderStill(renderer, params, progress), renderStill(whole, params, progress)), 0);
    options.maxBufferTexels = whole.memory().radianceElements / 8;
    EXPECT_EQ(Renderer(room.scene, room.field, options).notices().size(), 1u);
}

TEST_F(OpenGl, ShowsAnAtlasLargerThanATextureShrunkAndSaysSo) {
    const BakedExample room = smallRoom("cornell");
    RendererOptions options;
    options.maxTextureSize = std::max(room.field.atlas.width, room.field.atlas.height) - 1;
    Renderer renderer(room.scene, room.field, options);
    EXPECT_EQ(renderer.notices().size(), 1u);
    const StillParams params = stillOf(room.camera("front"));
    Progress progress;
    EXPECT_LT(meanFlip(renderStill(renderer, params, progress),
                       renderStill(room.scene, room.rays, room.field, params, progress)),
              0.05);
    options.maxTextureSize = 4;
    EXPECT_THROW(Renderer(room.scene, room.field, options), InputError);
}

TEST_F(OpenGl, TakesTheMemoryThatIsToldWithoutIt) {
    const BakedExample office = smallRoom("office");
    for (const BakedExample* room : {&office, &mirrorRoom()}) {
        const GpuMemory told = gpuMemoryOf(room->scene, room->field);
        const GpuMemory taken = Renderer(room->scene, room->field).memory();
        EXPECT_EQ(told.geometry, taken.geometry);
        EXPECT_EQ(told.atlas, taken.atlas);
        EXPECT_EQ(told.textures, taken.textures);
        EXPECT_EQ(told.radiance, taken.radiance);
        EXPECT_EQ(told.radianceElements, taken.radianceElements);
    }
}

TEST_F(OpenGl, SaysHowMuchMemoryItTakes) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    const GpuMemory& memory = renderer.memory();
    EXPECT_EQ(memory.hits, 0u);
    const std::uint64_t ofField = memory.total();
    EXPECT_EQ(memory.atlas, 4 * mirrorRoom().field.atlas.irradiance.size());
    EXPECT_GT(memory.geometry, 0u);
    EXPECT_GE(memory.radiance, 4 * memory.radianceElements);
    StillParams params = stillOf(mirrorRoom().camera("mirror"));
    params.mode = DisplayMode::raytraced;
    Progress progress;
    renderStill(renderer, params, progress);
    EXPECT_GE(memory.hits, 2 * 16 * mirrorRoom().scene.triangles.size());
    EXPECT_EQ(memory.total(), ofField + memory.hits);
}

}  // namespace vlf::test
