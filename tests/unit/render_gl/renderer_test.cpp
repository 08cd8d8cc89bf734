#include "vlf/render/gl/renderer.h"

#include "small_rooms.h"
#include "vlf/base/error.h"
#include "vlf/image/flip.h"
#include "vlf/image/srgb.h"
#include "vlf/image/tone_map.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/gpu_memory.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/read_framebuffer.h"
#include "vlf/render/gl/still.h"

#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

using gl::HeadlessContext;

void noteMessage(GLenum, GLenum, GLuint, GLenum severity, GLsizei, const GLchar* text,
                 const void* messages) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    static_cast<std::vector<std::string>*>(const_cast<void*>(messages))->push_back(text);
}

/// A context that must not have had anything to complain of by the end of the test.
class OpenGl : public ::testing::Test {
  protected:
    void SetUp() override {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(noteMessage, &messages_);
    }
    void TearDown() override {
        EXPECT_EQ(gl::liveObjects(), 0);
        EXPECT_EQ(messages_, std::vector<std::string>());
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }

    HeadlessContext context_{true};
    std::vector<std::string> messages_;
};

/// A picture for the display.
struct Target {
    gl::Framebuffer framebuffer = gl::makeFramebuffer();
    gl::TextureObject color = gl::makeTexture(GL_TEXTURE_2D);
    gl::TextureObject depth = gl::makeTexture(GL_TEXTURE_2D);

    Target(int width, int height) {
        glTextureStorage2D(color.id(), 1, GL_RGBA8, width, height);
        glTextureStorage2D(depth.id(), 1, GL_DEPTH_COMPONENT24, width, height);
        glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
        glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
    }
};

StillParams stillOf(const Camera& camera, LookupKind lookup = LookupKind::depthCorrected) {
    StillParams params;
    params.camera = camera;
    params.width = 160;
    params.height = 120;
    params.mode = DisplayMode::field;
    params.lookup = lookup;
    return params;
}

double meanFlip(const Image& picture, const Image& reference) {
    const float exposure = autoExposure(reference);
    const auto error = flip(toneMap(picture, exposure, ToneCurve::filmic),
                            toneMap(reference, exposure, ToneCurve::filmic))
                           .error;
    return std::accumulate(error.begin(), error.end(), 0.0) / static_cast<double>(error.size());
}

double flipAgainstCpu(const BakedExample& room, const StillParams& params) {
    Progress progress;
    Renderer renderer(room.scene, room.field);
    return meanFlip(renderStill(renderer, params, progress),
                    renderStill(room.scene, room.rays, room.field, params, progress));
}

}  // namespace

TEST_F(OpenGl, DrawsDiffuseRoomsAsTheCpuDoes) {
    for (const auto& [name, camera] : {std::pair{"cornell", "front"}, {"two-rooms", "door"}}) {
        const BakedExample room = smallRoom(name);
        EXPECT_LT(flipAgainstCpu(room, stillOf(room.camera(camera))), 0.01) << name;
    }
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
    glViewport(3, 4, 50, 40);
    glScissor(5, 6, 7, 8);
    glEnable(GL_BLEND);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glCullFace(GL_FRONT);
    glFrontFace(GL_CW);
    glClearColor(0.25f, 0.5f, 0.75f, 1);
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, target.color.id());
    const auto state = [] {
        std::vector<GLint> values;
        for (const GLenum name :
             {GL_VIEWPORT, GL_SCISSOR_BOX, GL_BLEND, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_CULL_FACE,
              GL_DEPTH_FUNC, GL_DEPTH_WRITEMASK, GL_CULL_FACE_MODE, GL_FRONT_FACE,
              GL_ACTIVE_TEXTURE, GL_TEXTURE_BINDING_2D, GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING,
              GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_UNIFORM_BUFFER_BINDING,
              GL_COLOR_CLEAR_VALUE}) {
            GLint value[4] = {0, 0, 0, 0};
            glGetIntegerv(name, value);
            values.insert(values.end(), value, value + 4);
        }
        return values;
    };
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
    LightField without = room.field;
    without.radiance = {};
    EXPECT_THROW(Renderer(room.scene, without), InputError);
    LightField other = room.field;
    other.triangleCharts.pop_back();
    EXPECT_THROW(Renderer(room.scene, other), InputError);
    Renderer renderer(room.scene, room.field);
    StillParams params = stillOf(room.camera("front"));
    params.mode = DisplayMode::raytraced;
    Progress progress;
    EXPECT_THROW(renderStill(renderer, params, progress), InputError);
    params = stillOf(room.camera("front"));
    progress.cancel();
    EXPECT_THROW(renderStill(renderer, params, progress), Cancelled);
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
    const Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    const GpuMemory& memory = renderer.memory();
    EXPECT_EQ(memory.atlas, 4 * mirrorRoom().field.atlas.irradiance.size());
    EXPECT_GT(memory.geometry, 0u);
    EXPECT_GE(memory.radiance, 4 * memory.radianceElements);
}

}  // namespace vlf::test
