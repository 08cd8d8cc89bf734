// Pictures of light fields whose radiance is known.

#include "vlf/render/cpu/still.h"

#include "baked_scene.h"
#include "picture_statistics.h"
#include "support/analytic_scenes.h"
#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/image/metrics.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/radiance_bake.h"

#include <cstring>

#include <gtest/gtest.h>

namespace vlf {
namespace {

using namespace test;

const Vec3 kAlbedo(0.3f, 0.5f, 0.8f), kEmission(1, 2, 0.5f);

void expectNear(const Vec3& a, const Vec3& b, float tolerance = 1e-4f) {
    EXPECT_LT(maxComponent(glm::abs(a - b)), tolerance)
        << a.x << " " << a.y << " " << a.z << " instead of " << b.x << " " << b.y << " " << b.z;
}

/// A square mirror or lamp of 2 x 2 m at the origin, facing +z, before a camera at z = 2.
Scene squareBeforeCamera(const Material& material) {
    SceneBuilder b;
    b.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, b.material("square", Vec3(0)));
    b.scene().materials.front() = material;
    b.camera("front", {0.1f, 0.2f, 2}, {0.1f, 0.2f, 0}, 30);
    return b.scene();
}

BakedScene baked(Scene scene) {
    BakedScene result(std::move(scene));
    BakeParams params = presetParams("draft");
    params.texelBudget = 6000;
    params.radianceDirections = 0;
    Progress progress;
    result.field = bake(result.scene, params, progress);
    return result;
}

TEST(Still, FurnaceIsOfConstantRadiance) {
    const Vec3 radiance = furnaceRadiance(kAlbedo, kEmission);
    for (const Scene& scene : {furnaceBox(kAlbedo, kEmission), furnaceSphere(kAlbedo, kEmission)})
        for (const Vec3& p : render(evenlyLit(scene, kPi * radiance), 40, 30).pixels)
            expectNear(p, radiance);
}

TEST(Still, FurnaceOfMirrorsIsOfConstantRadiance) {
    const Vec3 mirror(0.3f, 0.2f, 0.1f);
    const Vec3 radiance = furnaceRadiance(kAlbedo * 0.5f + mirror, kEmission);
    const BakedScene box =
        evenlyLit(furnaceMirrorBox(kAlbedo * 0.5f, mirror, kEmission), kPi * radiance);
    for (const Vec3& p : render(box, 40, 30).pixels) expectNear(p, radiance, 1e-3f);
}

TEST(Still, EmitterShowsItsRadianceOnItsFrontOnly) {
    Material lamp;
    lamp.diffuse = Vec3(0);
    lamp.emission = {17, 12, 4};
    BakedScene front = evenlyLit(squareBeforeCamera(lamp), Vec3(1));
    expectNear(render(front, 5, 5).at(2, 2), lamp.emission);

    StillParams behind = stillParams(front.scene.cameras.front(), 5, 5);
    behind.camera.eye.z = -2;
    expectNear(render(front, behind).at(2, 2), Vec3(0));
    front.scene.materials.front().emitsBothSides = true;
    for (TriangleCharts& charts : front.field.triangleCharts) charts.back = charts.front;
    expectNear(render(front, behind).at(2, 2), lamp.emission);
}

TEST(Still, SideWithoutChartIsBlack) {
    Material lamp;
    lamp.emission = Vec3(3);
    BakedScene square = evenlyLit(squareBeforeCamera(lamp), Vec3(1));
    EXPECT_GT(render(square, 5, 5).at(2, 2).x, 3);
    for (TriangleCharts& charts : square.field.triangleCharts) charts.front = kNoChart;
    for (const Vec3& p : render(square, 5, 5).pixels) EXPECT_EQ(p, Vec3(0));
}

TEST(Still, TextureColoursTheReflectedLight) {
    Material material;
    material.diffuse = {0.5f, 1, 1};
    material.diffuseTexture = 0;
    Scene scene = squareBeforeCamera(material);
    Texture leftHalfWhite;
    leftHalfWhite.width = leftHalfWhite.height = 64;
    for (int i = 0; i < 64 * 64; ++i) leftHalfWhite.linear.push_back(Vec3(i % 64 < 32 ? 1 : 0));
    scene.textures.push_back(leftHalfWhite);
    const Image image = render(evenlyLit(scene, Vec3(kPi)), 40, 30);
    expectNear(image.at(5, 15), {0.5f, 1, 1});
    expectNear(image.at(35, 15), Vec3(0));
}

/// Lamps of several colours in a dark hall, on the side x > 0, and a camera that looks at the plane
/// x = 0 there.
SceneBuilder lampsToMirror() {
    SceneBuilder b;
    b.box(Vec3(-9), Vec3(9), true, b.material("dark", Vec3(0)));
    b.quad({3, -2, -2}, {0, 0, 3}, {0, 3, 0}, b.material("red", Vec3(0), {3, 0.5f, 0.2f}));
    b.quad({2, 0, 0}, {0, 0, 1}, {0, 1.5f, 0}, b.material("green", Vec3(0), {0.2f, 2, 0.4f}));
    b.quad({1.7f, -1, -1}, {0, 0, 0.5f}, {0, 0.6f, 0}, b.material("blue", Vec3(0), {0, 0.3f, 5}));
    b.camera("to mirror", {1.5f, 0.2f, 0.1f}, {0, 0.1f, 0}, 60);
    return b;
}

TEST(Still, MirrorShowsWhatTheMirroredCameraSees) {
    SceneBuilder withMirror = lampsToMirror();
    const Vec3 reflectance(0.9f, 0.8f, 0.7f);
    withMirror.quad({0, -9, -9}, {0, 18, 0}, {0, 0, 18},
                    withMirror.material("mirror", Vec3(0), Vec3(0), reflectance));
    Scene lamps = lampsToMirror().scene();
    for (Vec3* p : {&lamps.cameras[0].eye, &lamps.cameras[0].look}) p->x = -p->x;

    StillParams params = stillParams(withMirror.scene().cameras.front(), 80, 60);
    params.antialias = 1;
    const Image image = render(evenlyLit(withMirror.scene(), Vec3(0)), params);
    params.camera = lamps.cameras.front();
    const Image expected = render(evenlyLit(lamps, Vec3(0)), params);
    int different = 0, lit = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) {
            const Vec3 truth = reflectance * expected.at(79 - x, y);
            different += maxComponent(glm::abs(image.at(x, y) - truth)) > 1e-3f;
            lit += maxComponent(truth) > 0;
        }
    EXPECT_GT(lit, 400);
    EXPECT_LE(different, 10) << "of " << lit << " lit pixels, at the lamps' edges";
}

glm::dvec3 meanOf(const Image& image) {
    glm::dvec3 sum(0);
    for (const Vec3& p : image.pixels) sum += glm::dvec3(p);
    return sum / static_cast<double>(image.pixels.size());
}

/// A metre's cube with a rough floor, half of it mirror, below a small lamp and a bulb.
Scene roughFloor(float roughness) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", {0.5f, 0.4f, 0.3f}));
    b.quad({0.4f, 0.9f, 0.3f}, {0.2f, 0, 0}, {0, 0, 0.2f}, b.material("lamp", Vec3(0), Vec3(20)));
    const std::uint32_t floor = b.material("floor", Vec3(0.2f), Vec3(0), {0.6f, 0.5f, 0.4f});
    b.scene().materials[floor].roughness = roughness;
    b.quad({0, 0.1f, 0}, {0, 0, 1}, {1, 0, 0}, floor);
    PunctualLight bulb;
    bulb.position = {0.8f, 0.8f, 0.2f};
    bulb.intensity = Vec3(0.05f);
    b.scene().lights.push_back(bulb);
    b.camera("front", {0.5f, 0.5f, 0.95f}, {0.5f, 0.1f, 0.3f}, 60);
    return b.scene();
}

// As wide as they are traced with the preset's directions.
TEST(Still, RoughMirrorsThatAreTracedReflectLampsAndRoom) {
    for (const float roughness : {0.02f, 0.1f, 0.2f}) {
        const BakedScene room = baked(roughFloor(roughness));
        const glm::dvec3 seen = meanOf(render(room, 32, 24));
        const MeanWithError truth = pictureMean(trace(room.scene, 32, 24, 2048));
        EXPECT_LT(relativeStandardError(truth), 0.003);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c] / truth.mean[c], 1, 0.01) << "roughness " << roughness;
    }
}

TEST(Still, TracedRoughMirrorsDoNotDependOnTheNumberOfThreads) {
    const BakedScene room = baked(roughFloor(0.15f));
    const Image all = render(room, 40, 30);
    const ThreadLimit one(1);
    EXPECT_EQ(render(room, 40, 30).pixels, all.pixels);
}

TEST(Still, MixtureAddsDiffuseAndMirroredLight) {
    SceneBuilder b = lampsToMirror();
    const Vec3 diffuse(0.2f, 0.3f, 0.1f), mirror(0.5f, 0.25f, 0.75f), irradiance(1, 2, 3);
    b.quad({0, -9, -9}, {0, 18, 0}, {0, 0, 18}, b.material("mix", diffuse, Vec3(0), mirror));
    StillParams params = stillParams(b.scene().cameras.front(), 1, 1);
    // Straight at the mirror, so that the red lamp behind the camera is seen.
    params.camera.eye = {0.5f, -1.5f, -1.5f};
    params.camera.look = {0, -1.5f, -1.5f};
    params.camera.verticalFov = 1;
    expectNear(render(evenlyLit(b.scene(), irradiance), params).at(0, 0),
               diffuse * irradiance / kPi + mirror * Vec3(3, 0.5f, 0.2f));
}

/// A mirror ball between walls that only emit, each its own colour: no light is left to chance.
Scene mirrorBallAmongLamps() {
    SceneBuilder b;
    b.box(Vec3(-2), Vec3(2), true, 0);
    for (int side = 0; side < 6; ++side) {
        const float s = static_cast<float>(side);
        const std::uint32_t m = b.material("wall", Vec3(0), {1 + s, 6 - s, 0.5f + (side % 3)});
        b.scene().triangles[2 * side].material = b.scene().triangles[2 * side + 1].material = m;
    }
    b.sphere(Vec3(0), 0.7f, 2, false, b.material("mirror", Vec3(0), Vec3(0), Vec3(0.9f)));
    b.camera("ball", {0.2f, 0.4f, 1.9f}, Vec3(0), 50);
    return b.scene();
}

TEST(Still, CurvedMirrorsAgreeWithThePathTracer) {
    const BakedScene ball = evenlyLit(mirrorBallAmongLamps(), Vec3(0));
    const Image reference = trace(ball.scene, 60, 45, 64).image;
    EXPECT_LT(relativeMse(render(ball, 60, 45), reference), 2e-3);
}

TEST(Still, BakedRoomAgreesWithThePathTracer) {
    const Scene scene = smallCornell();
    const Image reference = trace(scene, 48, 48, 256).image;
    EXPECT_LT(relativeMse(render(baked(scene), 48, 48), reference), 0.02);
}

TEST(Still, LookedUpMirrorsAgreeWithTracedOnes) {
    BakedScene room = baked(mirrorBox());
    RadianceParams params;
    params.lines = 513;
    params.cells = 128;
    Progress progress;
    room.field.radiance = bakeRadiance(room.scene, room.rays, room.field, params, progress);
    const Image traced = render(room, 48, 48);
    StillParams still = stillParams(room.scene.cameras.front(), 48, 48, DisplayMode::field);
    const double depthCorrected = relativeRmse(render(room, still), traced);
    EXPECT_LT(depthCorrected, 0.3);
    still.lookup = LookupKind::plain;
    EXPECT_LT(depthCorrected, relativeRmse(render(room, still), traced));
}

TEST(Still, LookingUpMirrorsNeedsTheirRadiance) {
    EXPECT_THROW(render(evenlyLit(mirrorBox(), Vec3(1)), 4, 4, DisplayMode::field), InputError);
    const BakedScene diffuse = evenlyLit(smallCornell(), Vec3(1));
    EXPECT_EQ(render(diffuse, 16, 16, DisplayMode::field).pixels, render(diffuse, 16, 16).pixels);
}

TEST(Still, PicturesAreTheSameForAnyNumberOfThreads) {
    const BakedScene ball = evenlyLit(mirrorBallAmongLamps(), Vec3(1));
    for (const DisplayMode mode :
         {DisplayMode::raytraced, DisplayMode::wireframe, DisplayMode::diagram}) {
        const Image reference = render(ball, 70, 45, mode);
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            EXPECT_EQ(render(ball, 70, 45, mode).pixels, reference.pixels) << threads;
        }
    }
}

TEST(Still, ReportsItsRays) {
    const BakedScene box = evenlyLit(furnaceBox(kAlbedo, kEmission), Vec3(1));
    StillParams params = stillParams(box.scene.cameras.front(), 40, 30);
    params.antialias = 2;
    Progress progress;
    StillReport report;
    renderStill(box.scene, box.rays, box.field, params, progress, &report);
    EXPECT_EQ(report.rays, 40u * 30u * 4u);
    EXPECT_GT(report.seconds, 0);
}

TEST(Still, RefusesWhatItCannotShow) {
    const BakedScene room = evenlyLit(smallCornell(), Vec3(1));
    for (const DisplayMode mode : {DisplayMode::raytraced, DisplayMode::field,
                                   DisplayMode::wireframe, DisplayMode::diagram}) {
        const StillParams good = stillParams(room.scene.cameras.front(), 8, 8, mode);
        StillParams bad = good;
        bad.camera.look = bad.camera.eye;
        EXPECT_THROW(render(room, bad), InputError);
        bad = good, bad.width = 0;
        EXPECT_THROW(render(room, bad), InputError);
        for (const int antialias : {0, -3, 17}) {
            bad = good, bad.antialias = antialias;
            EXPECT_THROW(render(room, bad), InputError);
        }
    }
    BakedScene mixedUp = evenlyLit(smallCornell(), Vec3(1));
    mixedUp.field = evenlyLit(mirrorBox(), Vec3(1)).field;
    EXPECT_THROW(render(mixedUp, 8, 8), InputError);
}

TEST(Still, CancellingStopsInEveryMode) {
    const BakedScene room = evenlyLit(smallCornell(), Vec3(1));
    StillParams params = stillParams(room.scene.cameras.front(), 64, 64);
    Progress progress;
    progress.cancel();
    const auto expectStop = [&] {
        EXPECT_THROW(renderStill(room.scene, room.rays, room.field, params, progress), Cancelled);
    };
    for (const DisplayMode mode :
         {DisplayMode::raytraced, DisplayMode::field, DisplayMode::wireframe}) {
        params.mode = mode;
        expectStop();
    }
    params.mode = DisplayMode::diagram;
    for (const DiagramKind kind :
         {DiagramKind::directions, DiagramKind::subfield, DiagramKind::tile, DiagramKind::chart}) {
        params.diagram.kind = kind;
        expectStop();
    }
}

}  // namespace
}  // namespace vlf
