// Hard shadows by OpenGL fall where rays to the light say.

#include "dynamic_example.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

const BakedExample& cornell() {
    static const BakedExample room = smallRoom("cornell");
    return room;
}

DynamicObject casterOf(const std::string& primitive, const Vec3& at, float scale) {
    DynamicObject object = objectOf(primitive, at, scale);
    object.settings.shadow = ShadowKind::hard;
    object.settings.hard = {1024, 0.6f};
    return object;
}

Image drawnWith(const BakedExample& room, const DynamicRoom& dynamic, StillParams params) {
    params.objects = &dynamic;
    Renderer renderer(room.scene, room.field);
    return drawn(renderer, params);
}

Image renderedWith(const BakedExample& room, const DynamicRoom& dynamic, StillParams params) {
    params.objects = &dynamic;
    Progress progress;
    return renderStill(room.scene, room.rays, room.field, params, progress);
}

/// The part of pixels that differ by more than a tenth.
double partDifferent(const Image& a, const Image& b) {
    int different = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        different += maxComponent(glm::abs(a.pixels[i] - b.pixels[i])) >
                     0.1f * maxComponent(b.pixels[i]) + 1e-3f;
    return different / static_cast<double>(a.pixels.size());
}

}  // namespace

// Above a block, so that the shadow lies on it and must not lie on what is below; beside it, so
// that it falls on faces that turn away from the light, where it must not show.
TEST_F(OpenGl, HardShadowsFallWhereRaysSay) {
    DynamicRoom dynamic(cornell().scene, cornell().rays, cornell().field);
    StillParams params = stillOf(cornell().camera("front"));
    params.antialias = 1;
    const Image without = drawnWith(cornell(), dynamic, params);
    dynamic.add(casterOf("cube", {3.3f, 4.2f, 3.2f}, 0.7f));
    dynamic.add(casterOf("knot", {1.7f, 2.6f, 1.8f}, 1.2f));
    dynamic.update();
    ASSERT_NE(dynamic.hardShadowLight(), nullptr);
    const Image picture = drawnWith(cornell(), dynamic, params);
    EXPECT_GT(partDifferent(picture, without), 0.03) << "there are shadows";
    EXPECT_LT(partDifferent(picture, renderedWith(cornell(), dynamic, params)), 0.01);
}

TEST_F(OpenGl, TheMostOpaqueHardShadowCounts) {
    DynamicRoom dynamic(cornell().scene, cornell().rays, cornell().field);
    dynamic.add(casterOf("cube", {2.7f, 3.6f, 2.0f}, 0.5f));
    dynamic.add(casterOf("cube", {2.7f, 4.4f, 2.3f}, 0.5f));
    ObjectSettings settings = dynamic.object(1).settings;
    settings.hard.opacity = 1;
    dynamic.setSettings(1, settings);
    dynamic.update();
    StillParams params = stillOf(cornell().camera("front"));
    params.antialias = 1;
    EXPECT_LT(partDifferent(drawnWith(cornell(), dynamic, params),
                            renderedWith(cornell(), dynamic, params)),
              0.01);
}

TEST_F(OpenGl, MirrorsShowHardShadowsInBothModes) {
    const BakedExample& room = mirrorRoom();
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    dynamic.add(casterOf("sphere", {2.9f, 1.6f, 3.4f}, 0.9f));
    dynamic.update();
    StillParams params = stillOf(room.camera("mirror"));
    params.mode = DisplayMode::raytraced;
    const Image traced = drawnWith(room, dynamic, params);
    EXPECT_LT(meanFlip(traced, renderedWith(room, dynamic, params)), 0.012);
    params.mode = DisplayMode::field;
    EXPECT_LT(meanFlip(drawnWith(room, dynamic, params), traced), 0.04);
}

}  // namespace vlf::test
