// The physics of the path tracer: scenes whose radiance is known.

#include "picture_statistics.h"
#include "support/analytic_scenes.h"
#include "vlf/math/microfacet.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

using namespace test;

const Vec3 kAlbedo(0.3f, 0.5f, 0.8f), kEmission(1, 2, 0.5f);

void expectFurnace(const Scene& scene, const Vec3& albedo, const PathOptions& paths = {}) {
    const MeanWithError mean = pictureMean(trace(scene, 24, 16, 128, paths));
    EXPECT_LT(relativeStandardError(mean), 0.02);
    EXPECT_LT(largestZ(mean, glm::dvec3(furnaceRadiance(albedo, kEmission))), kMaxZ);
}

TEST(PathTransport, WhiteFurnaceInABox) {
    expectFurnace(furnaceBox(kAlbedo, kEmission), kAlbedo);
}

TEST(PathTransport, WhiteFurnaceWithoutEmitterSampling) {
    expectFurnace(furnaceBox(kAlbedo, kEmission), kAlbedo, {0, false});
}

TEST(PathTransport, WhiteFurnaceInASmoothSphere) {
    expectFurnace(furnaceSphere(kAlbedo, kEmission, 1), kAlbedo);
}

TEST(PathTransport, WhiteFurnaceKeepsItsEnergyWithStronglyTiltedShadingNormals) {
    expectFurnace(furnaceSphere(kAlbedo, kEmission, 0), kAlbedo);
}

TEST(PathTransport, WhiteFurnaceOfPartlyMirroringWalls) {
    const Vec3 mirror(0.4f, 0.2f, 0.1f);
    expectFurnace(furnaceMirrorBox(kAlbedo, mirror, kEmission), kAlbedo + mirror);
}

TEST(PathTransport, WhiteFurnaceOfMirrors) {
    expectFurnace(furnaceMirrorBox(Vec3(0), kAlbedo, kEmission), kAlbedo);
}

/// A rough mirror seen aslant in a room that shines evenly.
Scene glowingRoomWithRoughMirror(float roughness) {
    SceneBuilder b;
    b.box(Vec3(-1), Vec3(1), true, b.material("glow", Vec3(0), kEmission));
    b.quad({-0.5f, 0, -0.5f}, {0, 0, 1}, {1, 0, 0},
           b.material("metal", Vec3(0.2f), Vec3(0), Vec3(0.6f)));
    b.scene().materials.back().roughness = roughness;
    b.camera("camera", {0, 0.2f, 0.4f}, Vec3(0), 5);
    return b.scene();
}

TEST(PathTransport, RoughMirrorsReflectTheirAlbedoInAFurnace) {
    const float cosine = 0.2f / std::hypot(0.2f, 0.4f);
    for (const float roughness : {0.02f, 0.1f, 0.4f, 1.0f})
        for (const bool sampleEmitters : {true, false}) {
            const MeanWithError mean = pictureMean(
                trace(glowingRoomWithRoughMirror(roughness), 16, 16, 256, {0, sampleEmitters}));
            EXPECT_LT(relativeStandardError(mean), 0.003);
            const double albedo = 0.2 + 0.6 * ggxAlbedo(roughness, cosine);
            EXPECT_NEAR(mean.mean.x / kEmission.x, albedo, 0.008 * albedo) << roughness;
        }
}

void expectSameWithoutEmitterSampling(const Scene& scene) {
    const MeanWithError with = pictureMean(trace(scene, 24, 24, 256));
    const MeanWithError without = pictureMean(trace(scene, 24, 24, 512, {0, false}, 2));
    EXPECT_LT(relativeStandardError(with), 0.02);
    EXPECT_LT(relativeStandardError(without), 0.03);
    EXPECT_LT(largestZ(with, without), kMaxZ);
}

TEST(PathTransport, EmitterSamplingDoesNotChangeTheMean) {
    expectSameWithoutEmitterSampling(smallCornell());
}

TEST(PathTransport, EmitterSamplingDoesNotChangeTheMeanOfLightByMirrors) {
    expectSameWithoutEmitterSampling(mirrorBox());
}

TEST(PathTransport, EmitterSamplingDoesNotChangeTheMeanOfRoughMirrors) {
    for (const float roughness : {0.05f, 0.5f}) {
        Scene scene = smallCornell();
        for (Material& m : scene.materials) {
            if (m.isEmitter()) continue;
            m.mirror = 0.5f * m.diffuse;
            m.diffuse *= 0.5f;
            m.roughness = roughness;
        }
        expectSameWithoutEmitterSampling(scene);
    }
}

TEST(PathTransport, EmitterSamplingDoesNotChangeTheMeanOfTexturedLamps) {
    Scene scene = smallCornell();
    Texture texture;
    texture.width = 4, texture.height = 4;
    for (int i = 0; i < 16; ++i) texture.linear.push_back(Vec3(i % 5 == 0 ? 1.0f : 0.05f));
    scene.textures.push_back(texture);
    for (Material& m : scene.materials)
        if (m.isEmitter()) m.emissionTexture = 0;
    expectSameWithoutEmitterSampling(scene);
}

TEST(PathTransport, EmitterSamplingLowersTheNoise) {
    const Scene scene = smallCornell();
    EXPECT_LT(2 * trace(scene, 24, 24, 64).relativeError,
              trace(scene, 24, 24, 64, {0, false}).relativeError);
}

/// A lamp of radiance 3 facing +z at the origin, seen from `side` · z.
Scene lampSeenFrom(float side, bool emitsBothSides) {
    SceneBuilder b;
    b.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, b.material("lamp", Vec3(0), Vec3(3)));
    b.scene().materials[0].emitsBothSides = emitsBothSides;
    b.camera("camera", {0, 0, side}, Vec3(0), 30);
    return b.scene();
}

TEST(PathTransport, EmittersShineOnTheWindingSideOnly) {
    EXPECT_EQ(trace(lampSeenFrom(1, false), 4, 4, 2).image.at(2, 2), Vec3(3));
    EXPECT_EQ(trace(lampSeenFrom(-1, false), 4, 4, 2).image.at(2, 2), Vec3(0));
    EXPECT_EQ(trace(lampSeenFrom(-1, true), 4, 4, 2).image.at(2, 2), Vec3(3));
}

/// The lamp lies at y = 1 over a white floor and faces up; a camera looks at the floor below it.
Scene lampFacingAway(bool emitsBothSides) {
    SceneBuilder b;
    b.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, b.material("floor", Vec3(0.5f)));
    b.quad({-1, 1, -1}, {0, 0, 2}, {2, 0, 0}, b.material("lamp", Vec3(0), Vec3(3)));
    b.scene().materials[1].emitsBothSides = emitsBothSides;
    b.camera("floor", {0, 0.5f, 0}, Vec3(0), 30, {0, 0, 1});
    return b.scene();
}

TEST(PathTransport, NoLightReachesWhatAnEmitterTurnsItsBackTo) {
    EXPECT_EQ(pictureMean(trace(lampFacingAway(false), 8, 8, 32)).mean, glm::dvec3(0));
    EXPECT_GT(pictureMean(trace(lampFacingAway(true), 8, 8, 32)).mean.x, 0.1);
}

TEST(PathTransport, SurfacesReflectOnBothSides) {
    Scene scene = lampFacingAway(true);
    const MeanWithError front = pictureMean(trace(scene, 8, 8, 1024));
    for (int i = 0; i < 2; ++i)
        std::swap(scene.triangles[i].vertex[1], scene.triangles[i].vertex[2]);
    EXPECT_LT(largestZ(front, pictureMean(trace(scene, 8, 8, 1024, {}, 2))), kMaxZ);
}

TEST(PathTransport, AMirrorShowsTheReflectedEmitter) {
    const PathTraceResult picture = trace(mirrorBox(), 33, 33, 16);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.image.at(16, 16)[c], 0.9f * 5, 1e-4f);
    // Beside the lamp's image the mirror shows the lit wall.
    EXPECT_GT(picture.image.at(3, 16).x, 0.01f);
    EXPECT_LT(picture.image.at(3, 16).x, 1.0f);
}

TEST(PathTransport, DepthCountsSegments) {
    const Scene scene = smallCornell();
    const MeanWithError emitted = pictureMean(trace(scene, 32, 32, 64, {1, true}));
    const MeanWithError direct = pictureMean(trace(scene, 32, 32, 64, {2, true}));
    const MeanWithError once = pictureMean(trace(scene, 32, 32, 64, {3, true}));
    const MeanWithError all = pictureMean(trace(scene, 32, 32, 64));
    EXPECT_LT(emitted.mean.x, direct.mean.x);
    EXPECT_LT(direct.mean.x, once.mean.x);
    EXPECT_LT(once.mean.x, all.mean.x);
    const MeanWithError chance = pictureMean(trace(scene, 32, 32, 512, {2, false}, 2));
    EXPECT_LT(largestZ(direct, chance), kMaxZ);
}

TEST(PathTransport, PerfectMirrorsFacingEachOtherEnd) {
    const Scene scene = furnaceMirrorBox(Vec3(0), Vec3(1), Vec3(0));
    EXPECT_EQ(pictureMean(trace(scene, 8, 8, 8)).mean, glm::dvec3(0));
}

TEST(PathTransport, NoEmitterNoLight) {
    const Scene scene = furnaceBox(Vec3(0.5f), Vec3(0));
    EXPECT_EQ(pictureMean(trace(scene, 8, 8, 8)).mean, glm::dvec3(0));
}

TEST(PathTransport, ResultDoesNotDependOnTheUnitOfLength) {
    const MeanWithError metres = pictureMean(trace(smallCornell(), 12, 12, 512));
    for (const float scale : {1e-3f, 1e5f}) {
        Scene scene = smallCornell();
        for (Vec3& p : scene.positions) p *= scale;
        scene.cameras[0].eye *= scale;
        scene.cameras[0].look *= scale;
        EXPECT_LT(largestZ(metres, pictureMean(trace(scene, 12, 12, 512, {}, 2))), kMaxZ) << scale;
    }
}

}  // namespace
}  // namespace vlf
