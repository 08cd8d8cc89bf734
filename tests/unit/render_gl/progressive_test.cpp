#include "vlf/render/gl/progressive.h"

#include "open_gl.h"
#include "small_rooms.h"
#include "vlf/render/gl/float_target.h"
#include "vlf/render/gl/tile_clock.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

constexpr int kWidth = 96, kHeight = 72;

/// Progressive pictures of the mirror room, as radiance.
class Walk {
  public:
    explicit Walk(const LightField& field = mirrorRoom().field)
        : renderer(mirrorRoom().scene, field), progressive(renderer) {
        settings.tone.reset();
        view = viewFrom("mirror");
    }

    View viewFrom(const std::string& camera) const {
        return viewOf(mirrorRoom().camera(camera), kWidth, kHeight, renderer.nearest());
    }
    /// One call.
    Image step(double seconds) {
        progressive.draw(view, settings, target_.framebuffer.id(), seconds);
        return picture();
    }
    /// Calls until there is no more to do.
    Image rest() {
        for (int i = 0; i < 100 && progressive.samples() < ProgressiveRenderer::kSamples; ++i)
            step(10);
        return picture();
    }
    Image drawn(DisplayMode mode) {
        RenderSettings once = settings;
        once.mode = mode;
        renderer.draw(view, once, target_.framebuffer.id());
        return picture();
    }

    Renderer renderer;
    ProgressiveRenderer progressive;
    View view;
    RenderSettings settings;

  private:
    Image picture() const {
        Image image(kWidth, kHeight);
        glGetTextureImage(target_.color.id(), 0, GL_RGB, GL_FLOAT,
                          static_cast<GLsizei>(image.pixels.size() * sizeof(Vec3)),
                          image.pixels.data());
        for (int y = 0; y < kHeight / 2; ++y)
            for (int x = 0; x < kWidth; ++x)
                std::swap(image.at(x, y), image.at(x, kHeight - 1 - y));
        return image;
    }

    gl::FloatTarget target_{kWidth, kHeight};
};

LightField withoutRadiance() {
    LightField field = mirrorRoom().field;
    field.radiance = {};
    return field;
}

}  // namespace

TEST_F(OpenGl, ProgressiveComesToTheRaytracedStill) {
    Walk walk;
    StillParams params = stillOf(mirrorRoom().camera("mirror"));
    params.width = kWidth;
    params.height = kHeight;
    params.mode = DisplayMode::raytraced;
    params.antialias = ProgressiveRenderer::kSamplesAlongSide;
    Progress progress;
    const Image expected = renderStill(walk.renderer, params, progress);
    const Image picture = walk.rest();
    EXPECT_EQ(walk.progressive.samples(), ProgressiveRenderer::kSamples);
    EXPECT_EQ(walk.progressive.progress(), 1);
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        difference += luminance(glm::abs(picture.pixels[i] - expected.pixels[i]));
        sum += luminance(expected.pixels[i]);
    }
    EXPECT_LT(difference / sum, 1e-4);
    EXPECT_EQ(walk.step(10).pixels, picture.pixels) << "and stays";
}

TEST_F(OpenGl, ProgressiveShowsTheFieldFirst) {
    Walk walk;
    const Image field = walk.drawn(DisplayMode::field);
    EXPECT_EQ(walk.step(0).pixels, field.pixels);
    EXPECT_LT(meanFlip(walk.step(0), field), 1e-3) << "until a sample takes its place";
    walk.view = walk.viewFrom("front");
    EXPECT_EQ(walk.step(10).pixels, walk.drawn(DisplayMode::field).pixels) << "of a new view";
    EXPECT_EQ(walk.progressive.progress(), 0);
}

TEST_F(OpenGl, ProgressiveShowsCoarseReflectionsWhereThereIsNoField) {
    Walk walk(withoutRadiance());
    const Image raytraced = walk.drawn(DisplayMode::raytraced);
    const Image first = walk.step(0);
    EXPECT_NE(first.pixels, raytraced.pixels);
    EXPECT_LT(meanFlip(first, raytraced), 0.25);
    Image later;
    for (int i = 0; i < 8; ++i) {  // time enough for all pixels
        walk.view = walk.viewFrom(i % 2 ? "mirror" : "front");
        later = walk.step(1000);
    }
    EXPECT_LT(meanFlip(later, raytraced), 1e-3);
}

TEST_F(OpenGl, ProgressiveDrawsOneSmallTileWhenThereIsNoTime) {
    Walk walk;
    walk.step(0);
    walk.step(0);
    double before = walk.progressive.progress();
    for (int i = 0; i < 5; ++i) {
        walk.step(0);
        const double added = walk.progressive.progress() - before;
        EXPECT_GT(added, 0);
        EXPECT_LE(added * ProgressiveRenderer::kSamples * kWidth * kHeight, 64 * 64);
        before += added;
    }
}

TEST_F(OpenGl, ProgressiveStartsAnewWhenTheRadianceChanges) {
    Walk walk;
    const auto startsAnew = [&](const char* what) {
        EXPECT_EQ(walk.progressive.progress(), 1) << "before " << what;
        walk.step(0);
        EXPECT_EQ(walk.progressive.progress(), 0) << what;
        walk.rest();
    };
    const Image before = walk.rest();
    walk.settings.exposure = 1;
    walk.step(0);
    EXPECT_EQ(walk.progressive.progress(), 1) << "exposure is of the display";
    walk.settings.textureBias = 1;
    startsAnew("texture bias");
    walk.settings.textureBias = 0;
    startsAnew("texture bias");
    walk.settings.lookup = LookupKind::plain;
    startsAnew("lookup");
    IrradianceAtlas dark = mirrorRoom().field.atlas;
    for (Vec3& e : dark.irradiance) e *= 0.5f;
    walk.renderer.updateIrradiance(dark);
    startsAnew("light");
    EXPECT_NEAR(luminance(walk.step(0).at(20, 30)) / luminance(before.at(20, 30)), 0.5f, 5e-3f);
    walk.view.width = kWidth / 2;
    startsAnew("size");
    walk.view = walk.viewFrom("statue");
    startsAnew("view");
}

TEST_F(OpenGl, ProgressiveLeavesTheStateOfItsHostAsItWas) {
    const BakedExample& room = mirrorRoom();
    Renderer renderer(room.scene, room.field);
    const Target target(64, 48);
    disturbState(target);
    const auto before = state();
    ProgressiveRenderer progressive(renderer);
    const View view = viewOf(room.camera("mirror"), 64, 48, renderer.nearest());
    for (int i = 0; i < 3; ++i) {
        progressive.draw(view, {}, target.framebuffer.id());
        EXPECT_EQ(state(), before);
    }
}

TEST(TileClock, ExpectsOfAPartOfThePictureWhatItTookBefore) {
    gl::TileClock clock;
    clock.resize(300, 200);
    const PixelRectangle cheap{0, 0, 128, 64}, dear{128, 64, 64, 64}, rest{256, 128, 44, 72};
    const double unknown = clock.shading(rest);
    for (int i = 0; i < 20; ++i) {
        clock.note(cheap, 2e-3);
        clock.note(dear, 20e-3);
    }
    EXPECT_NEAR(clock.drawing(cheap), 2e-3, 1e-4);
    EXPECT_NEAR(clock.drawing(dear), 20e-3, 1e-3);
    EXPECT_NEAR(clock.shading({64, 0, 128, 128}), 18e-3 + 2 * 64 * 64 * 2e-6, 2e-3);
    EXPECT_EQ(clock.shading(rest), unknown);
    clock.note(cheap, 50e-3);
    EXPECT_LT(clock.drawing(cheap), 30e-3) << "once may be chance";
}

}  // namespace vlf::test
