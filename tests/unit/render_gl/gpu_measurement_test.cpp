#include "small_rooms.h"
#include "vlf/image/tone_map.h"
#include "vlf/render/gl/driver.h"
#include "vlf/render/gl/exposure_meter.h"
#include "vlf/render/gl/gpu_timer.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/still.h"

#include <gtest/gtest.h>

namespace vlf::gl::test {

namespace {

using vlf::test::BakedExample;

TEST(Context, IsNotLostWhileAllIsWell) {
    const HeadlessContext context;
    EXPECT_FALSE(contextLost());
}

TEST(GpuTimer, MeasuresWithoutWaiting) {
    const HeadlessContext context;
    {
        GpuTimer timer;
        const TextureObject texture = makeTexture(GL_TEXTURE_2D);
        glTextureStorage2D(texture.id(), 1, GL_RGBA8, 64, 64);
        EXPECT_FALSE(timer.milliseconds());
        for (int frame = 0; frame < 20; ++frame) {
            const TimedPass pass(timer);
            glClearTexImage(texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        }
        glFinish();
        ASSERT_TRUE(timer.milliseconds());
        EXPECT_GE(*timer.milliseconds(), 0);
        EXPECT_LT(*timer.milliseconds(), 10000);
    }
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_EQ(liveObjects(), 0);
}

TEST(ExposureMeter, FindsTheExposureOfAStill) {
    const HeadlessContext context;
    const BakedExample room = vlf::test::smallRoom("cornell");
    {
        Renderer renderer(room.scene, room.field);
        ExposureMeter meter;
        EXPECT_FALSE(meter.exposure());
        Progress progress;
        for (const char* name : {"front", "inside"}) {
            StillParams params;
            params.camera = room.camera(name);
            params.width = 200;
            params.height = 100;
            params.mode = DisplayMode::field;
            const float expected = autoExposure(renderStill(renderer, params, progress));
            meter.measure(renderer, params.camera, 2);
            glFinish();
            ASSERT_TRUE(meter.exposure());
            // The meter sees few points of the view; a tenth is not noticed.
            EXPECT_NEAR(*meter.exposure(), expected, 0.1f) << name;
        }
    }
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_EQ(liveObjects(), 0);
}

}  // namespace

}  // namespace vlf::gl::test
