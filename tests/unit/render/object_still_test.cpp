// Pictures of rooms with objects in them.

#include "object_room.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/image/metrics.h"
#include "vlf/render/cpu/object_faces.h"
#include "vlf/render/cpu/path_tracer.h"
#include "vlf/render/cpu/projection.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

using namespace test;

const Vec3 kGlow(0, 40, 0);

/// The room of smallCornell with a partition before its left half.
Scene partitionedRoom() {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", Vec3(0.5f)));
    b.box({0.1f, 0.1f, 0.5f}, {0.45f, 0.9f, 0.52f}, false, b.material("partition", Vec3(0.3f)));
    b.camera("front", {0.5f, 0.5f, 0.95f}, {0.5f, 0.5f, 0}, 70);
    return b.scene();
}

bool glows(const Vec3& radiance) {
    return radiance.g > 20;
}

std::size_t glowingPixels(const Image& image) {
    return static_cast<std::size_t>(std::count_if(image.pixels.begin(), image.pixels.end(), glows));
}

/// Intersection over union of what glows in two pictures.
double overlap(const Image& a, const Image& b) {
    std::size_t both = 0, either = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        both += glows(a.pixels[i]) && glows(b.pixels[i]);
        either += glows(a.pixels[i]) || glows(b.pixels[i]);
    }
    return either > 0 ? static_cast<double>(both) / static_cast<double>(either) : 1;
}

TEST(ObjectStill, AnObjectHidesTheRoomAndIsHiddenByIt) {
    const BakedScene baked = evenlyLit(partitionedRoom(), Vec3(2));
    const Material glow = plain(Vec3(0.25f), Vec3(0), kGlow);
    const auto seenAt = [&](const Vec3& place) {
        return glowingPixels(
            ObjectRoom(baked, {flatObject("cube", glow, place, 0.1f)}).picture(60, 60));
    };
    EXPECT_GT(seenAt({0.75f, 0.5f, 0.3f}), 20u);  // beside the partition
    EXPECT_GT(seenAt({0.3f, 0.5f, 0.7f}), 20u);   // before it
    EXPECT_EQ(seenAt({0.3f, 0.5f, 0.3f}), 0u);    // behind it
}

TEST(ObjectStill, ADiffuseObjectShowsItsLightAndItsOwn) {
    const BakedScene baked = evenlyLit(partitionedRoom(), Vec3(2));
    const ObjectRoom room(baked,
                          {flatObject("sphere", plain({0.2f, 0.4f, 0.6f}, Vec3(0), {0, 0, 1}),
                                      {0.5f, 0.5f, 0.6f}, 0.2f)});
    const Vec3 seen = room.picture(31, 31).at(15, 15);
    const Vec3 expected = Vec3(0, 0, 1) + Vec3(0.2f, 0.4f, 0.6f) * (2 / kPi);
    EXPECT_LT(maxComponent(glm::abs(seen - expected)), 1e-3f);
}

TEST(ObjectStill, ATurnedObjectIsWhereItsPosePutsIt) {
    const BakedScene baked = evenlyLit(partitionedRoom(), Vec3(2));
    DynamicObject turned =
        flatObject("cube", plain(Vec3(0), Vec3(0), kGlow), {0.7f, 0.4f, 0.5f}, 0.2f);
    turned.pose.rotation = glm::angleAxis(0.7f, glm::normalize(Vec3(1, 2, 3)));
    BakedScene posed = evenlyLit(posedScene(baked.scene, std::array{turned}), Vec3(2));
    StillParams params = stillParams(baked.scene.cameras.front(), 80, 80);
    params.antialias = 1;
    const Image still = render(posed, params);
    EXPECT_GT(overlap(ObjectRoom(baked, {turned}).picture(80, 80), still), 0.97);
}

TEST(ObjectStill, AnObjectFarAwayChangesNothing) {
    const BakedScene baked = bakedCoarsely(mirrorBox());
    DynamicObject far = flatObject("cube", plain(Vec3(0.5f)), {500, 0, 0}, 1);
    far.settings = {};
    const ObjectRoom without(baked, {}), with(baked, {far});
    for (const DisplayMode mode :
         {DisplayMode::raytraced, DisplayMode::field, DisplayMode::wireframe})
        EXPECT_EQ(with.picture(40, 30, mode).pixels, without.picture(40, 30, mode).pixels);
}

/// A lamp beside the camera of mirrorBox is seen in the mirror alone.
TEST(ObjectStill, MirrorsShowObjectsAtTheRightPixelsInBothModes) {
    const BakedScene baked = bakedCoarsely(mirrorBox());
    const Vec3 place(0.4f, 0.15f, 0.2f);
    const ObjectRoom room(baked, {flatObject("cube", plain(Vec3(0), Vec3(0), kGlow), place, 0.2f)});
    const Image traced = room.picture(80, 60), lookedUp = room.picture(80, 60, DisplayMode::field);
    EXPECT_GT(glowingPixels(traced), 20u);
    EXPECT_GT(overlap(traced, lookedUp), 0.97);
    const Projection projection(baked.scene.cameras.front(), 80, 60);
    const Vec2 image = projection.project(Vec3(-2 - place.x, place.y, place.z))->position;
    const Vec3 expected = 0.9f * kGlow;
    for (const Image& picture : {traced, lookedUp})
        EXPECT_LT(maxComponent(glm::abs(
                      picture.at(static_cast<int>(image.x), static_cast<int>(image.y)) - expected)),
                  1e-3f);
}

TEST(ObjectStill, RoughMirrorsThatAreTracedShowObjects) {
    Scene scene = mirrorBox();
    for (Material& material : scene.materials)
        if (material.isSpecular()) material.roughness = 0.05f;
    const BakedScene perfect = bakedCoarsely(mirrorBox()), rough = bakedCoarsely(scene);
    const auto picture = [](const BakedScene& baked, const Vec3& glow) {
        const DynamicObject cube =
            flatObject("cube", plain(Vec3(0), Vec3(0), glow), {0.4f, 0.15f, 0.2f}, 0.2f);
        return ObjectRoom(baked, {cube}).picture(80, 60);
    };
    const auto greenOf = [&](const Vec3& glow) {
        double sum = 0;
        for (const Vec3& p : picture(rough, glow).pixels) sum += p.g;
        return sum;
    };
    const double expected =
        0.9 * kGlow.g * static_cast<double>(glowingPixels(picture(perfect, kGlow)));
    EXPECT_NEAR(greenOf(kGlow) - greenOf(Vec3(0)), expected, 0.1 * expected);
}

TEST(ObjectStill, MirrorsDoNotShowWhatTheRoomHides) {
    Scene scene = mirrorBox();
    SceneBuilder screen;
    screen.box({0.55f, -0.6f, -0.6f}, {0.6f, 0.6f, 0.6f}, false,
               screen.material("screen", Vec3(0.5f)));
    append(scene, screen.scene());
    const BakedScene baked = bakedCoarsely(scene);
    const ObjectRoom room(baked,
                          {flatObject("cube", plain(Vec3(0), Vec3(0), kGlow), {0.8f, 0, 0}, 0.1f)});
    EXPECT_EQ(glowingPixels(room.picture(80, 60)), 0u);
    EXPECT_EQ(glowingPixels(room.picture(80, 60, DisplayMode::field)), 0u);
}

/// How much of the light in each pixel an object leaves, by luminance.
std::vector<float> remainingLight(const ObjectRoom& with, const ObjectRoom& without,
                                  DisplayMode mode) {
    const Image now = with.picture(80, 60, mode), before = without.picture(80, 60, mode);
    std::vector<float> remaining;
    for (std::size_t i = 0; i < now.pixels.size(); ++i)
        remaining.push_back(luminance(now.pixels[i]) / luminance(before.pixels[i]));
    return remaining;
}

TEST(ObjectStill, LookedUpMirrorsShowTheShadowsOfObjects) {
    const BakedScene baked = bakedCoarsely(mirrorBox(), 6000);
    DynamicObject shade = flatObject("cube", plain(Vec3(0)), {0.6f, -0.55f, 0}, 0.3f);
    shade.settings.shadow = ShadowKind::field;
    const ObjectRoom with(baked, {shade}), without(baked, {});
    const std::vector<float> traced = remainingLight(with, without, DisplayMode::raytraced),
                             lookedUp = remainingLight(with, without, DisplayMode::field);
    double shadow = 0, left = 0;
    for (std::size_t i = 0; i < traced.size(); ++i) {
        if (traced[i] < 1e-3f || lookedUp[i] < 1e-3f) continue;  // the black object itself
        shadow += std::abs(1 - traced[i]);
        left += std::abs(lookedUp[i] - traced[i]);
    }
    EXPECT_GT(shadow / static_cast<double>(traced.size()), 0.01);
    EXPECT_LT(left, 0.2 * shadow);
}

TEST(ObjectStill, AMirrorObjectInAFurnaceShowsTheFurnace) {
    const Vec3 albedo(0.3f, 0.5f, 0.8f), emission(1, 2, 0.5f);
    const Vec3 radiance = furnaceRadiance(albedo, emission);
    const BakedScene baked = evenlyLit(furnaceBox(albedo, emission), kPi * radiance);
    const ObjectRoom room(
        baked, {flatObject("sphere", plain(Vec3(0), Vec3(0.5f)), {0.55f, 0.5f, 0.6f}, 0.3f)});
    for (const DisplayMode mode : {DisplayMode::raytraced, DisplayMode::field})
        EXPECT_LT(maxComponent(glm::abs(room.picture(31, 31, mode).at(15, 15) - 0.5f * radiance)),
                  1e-3f);
}

TEST(ObjectStill, ALookedUpMirrorObjectShowsTheRoomAsATracedOne) {
    const BakedScene baked = evenlyLit(partitionedRoom(), Vec3(2));
    BakedScene painted(baked.scene);
    painted.field = baked.field;
    // Irradiance by place, so that the reflections have features.
    for (const Chart& chart : painted.field.charts)
        for (std::uint32_t y = 0; y < chart.height; ++y)
            for (std::uint32_t x = 0; x < chart.width; ++x)
                painted.field.atlas
                    .irradiance[painted.field.atlas.index(chart.x + x, chart.y + y)] =
                    Vec3(static_cast<float>(x + 1) / chart.width,
                         static_cast<float>(y + 1) / chart.height, 0.5f);
    const DynamicObject mirror =
        flatObject("sphere", plain(Vec3(0), Vec3(0.9f)), {0.65f, 0.45f, 0.5f}, 0.3f);
    const DynamicObject glow =
        flatObject("cube", plain(Vec3(0), Vec3(0), kGlow), {0.75f, 0.7f, 0.6f}, 0.1f);
    const ObjectRoom room(painted, {mirror, glow});
    const Image traced = room.picture(80, 80), lookedUp = room.picture(80, 80, DisplayMode::field);
    EXPECT_LT(relativeRmse(lookedUp, traced), 0.05);
    EXPECT_GT(overlap(traced, lookedUp), 0.98);
}

TEST(ObjectStill, TwoMirrorObjectsShowEachOther) {
    const BakedScene baked = evenlyLit(partitionedRoom(), Vec3(2));
    const Material mirror = plain(Vec3(0), Vec3(0.9f));
    const ObjectRoom room(baked, {flatObject("sphere", mirror, {0.6f, 0.5f, 0.6f}, 0.15f),
                                  flatObject("sphere", mirror, {0.8f, 0.5f, 0.6f}, 0.15f)});
    EXPECT_LT(relativeRmse(room.picture(80, 80, DisplayMode::field), room.picture(80, 80)), 0.06);
}

TEST(ObjectStill, AWireframeDrawsTheObjectAndHidesWhatIsBehindIt) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", Vec3(0.5f)));
    b.box({0.45f, 0.45f, 0.1f}, {0.55f, 0.55f, 0.2f}, false, b.material("block", Vec3(0.3f)));
    b.camera("front", {0.5f, 0.5f, 0.95f}, {0.5f, 0.5f, 0}, 70);
    const BakedScene baked = evenlyLit(b.scene(), Vec3(2));
    const ObjectRoom empty(baked, {}),
        room(baked, {flatObject("cube", plain(Vec3(0.5f)), {0.5f, 0.5f, 0.6f}, 0.2f)});
    const Image before = empty.picture(120, 120, DisplayMode::wireframe),
                after = room.picture(120, 120, DisplayMode::wireframe);
    const Projection projection(baked.scene.cameras.front(), 120, 120);
    const auto at = [&](const Image& image, const Vec3& p) {
        const Vec2 pixel = projection.project(p)->position;
        return luminance(image.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y)));
    };
    const Vec3 onCube(0.5f, 0.6f, 0.7f), onBlock(0.5f, 0.55f, 0.2f);
    EXPECT_LT(at(after, onCube), 0.6f * at(before, onCube));
    EXPECT_GT(at(after, onBlock), at(before, onBlock) + 0.1f);
}

TEST(ObjectStill, AnObjectIsLitAsPathTracingSays) {
    BakedScene baked(smallCornell());
    BakeParams bakeParams = presetParams("draft");
    bakeParams.texelBudget = 8000;
    Progress progress;
    baked.field = bake(baked.scene, bakeParams, progress);
    DynamicObject cube = flatObject("cube", plain({0.6f, 0.6f, 0.5f}), {0.3f, 0.4f, 0.7f}, 0.1f);
    cube.pose.rotation = glm::angleAxis(0.8f, Vec3(0, 1, 0));
    cube.settings = {};
    const ObjectRoom room(baked, {cube});
    const Scene posed = posedScene(baked.scene, std::array{cube});
    PathTraceParams params;
    params.camera = baked.scene.cameras.front();
    params.camera.verticalFov = 5;
    params.camera.look = cube.pose.translation;
    params.width = 48, params.height = 36;
    params.samplesPerPixel = 256;
    const Image truth = pathTrace(posed, RayScene(posed), params, progress).image;
    StillParams still = stillParams(params.camera, 48, 36);
    still.objects = &room.objects;
    const std::vector<FaceRadiance> faces =
        compareFaces(room.objects, baked.rays, params.camera, render(baked, still), truth);
    EXPECT_GE(faces.size(), 2u);
    for (const FaceRadiance& face : faces)
        EXPECT_LT(std::abs(face.error()), 0.07) << face.pixels << " pixels, " << face.normal.y;
}

}  // namespace
}  // namespace vlf
