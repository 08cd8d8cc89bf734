// The light of objects in baked rooms against path tracing, and what becomes of all energy.

#include "posed_truth.h"

#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

const BakedRoom& lampLit() {
    static const BakedRoom baked(lampRoom(1, 0.5f, {0.6f, 0.1f, 0.1f}), 4000);
    return baked;
}

const RoomTexels& texels() {
    static const RoomTexels made = makeRoomTexels(lampLit().scene, lampLit().rays, lampLit().field);
    return made;
}

DynamicObject finely(DynamicObject object) {
    object.settings.gather.lines = 513;
    return object;
}

void expectFacesAsTraced(const DynamicRoom& room, const std::vector<Vec3>& normals,
                         double tolerance) {
    const std::vector<IrradianceEstimate> truth = tracedFaces(room, normals, 30000);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Vec3 found = meanIrradiance(room.litObjects().back(), normals[i]);
        for (int c = 0; c < 2; ++c)
            EXPECT_NEAR(found[c] / truth[i].mean[c], 1, tolerance)
                << "face " << i << " channel " << c << ", traced " << truth[i].mean[c] << " +- "
                << truth[i].standardError[c];
    }
}

const std::vector<Vec3> kSides{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

TEST(DynamicLight, OnACubeInTheLightIsAsTraced) {
    const FilledRoom filled(lampLit(), {finely(bodyAt("cube", {0.6f, 0.8f, 1.2f}, 0.4f))});
    std::vector<Vec3> all = kSides;
    all.push_back({0, -1, 0});
    expectFacesAsTraced(filled.room, all, 0.03);
}

TEST(DynamicLight, OnACubeOnTheFloorIsAsTraced) {
    const FilledRoom filled(lampLit(), {finely(bodyAt("cube", {0.7f, 0.2f, 0.9f}, 0.4f))});
    expectFacesAsTraced(filled.room, kSides, 0.05);
}

TEST(DynamicLight, OnACubeInTheShadowOfAnotherIsAsTraced) {
    const FilledRoom filled(lampLit(),
                            {finely(bodyAt("cube", {1, 1.1f, 1}, 0.3f, {0.2f, 0.7f, 0.2f})),
                             finely(bodyAt("cube", {1, 0.7f, 1}, 0.2f))});
    std::vector<Vec3> all = kSides;
    all.push_back({0, -1, 0});
    expectFacesAsTraced(filled.room, all, 0.05);
}

TEST(DynamicLight, BetweenTwoOthersThatShadeTheFloorIsAsTraced) {
    const FilledRoom filled(lampLit(), {finely(bodyAt("cube", {0.5f, 0.15f, 0.3f}, 0.3f)),
                                        finely(bodyAt("cube", {1.34f, 0.15f, 0.3f}, 0.3f)),
                                        finely(bodyAt("cube", {0.92f, 0.15f, 0.3f}, 0.3f))});
    expectFacesAsTraced(filled.room, kSides, 0.07);
}

TEST(DynamicLight, WhereAnotherHidesTheLampFromMostOfTheRoomIsRoughlyAsTraced) {
    // Later bounces of so large a change are taken to be even all over the room.
    const FilledRoom filled(lampLit(),
                            {finely(bodyAt("cube", {1, 1.4f, 1}, 0.7f, {0.2f, 0.7f, 0.2f})),
                             finely(bodyAt("cube", {1, 0.5f, 1}, 0.3f))});
    const Vec3 before = meanIrradiance(texels(), filled.room.roomIrradiance());
    const std::vector<IrradianceEstimate> truth = tracedFaces(filled.room, kSides, 30000);
    for (std::size_t i = 0; i < kSides.size(); ++i) {
        const Vec3 found = meanIrradiance(filled.room.litObjects().back(), kSides[i]);
        EXPECT_LT(maxComponent(glm::abs(found - truth[i].mean) / before), 0.05f) << "face " << i;
    }
}

TEST(DynamicLight, OfEmittersMetByDirectionsIsNearToTheirSamples) {
    DynamicObject sampled = finely(bodyAt("sphere", {0.8f, 0.6f, 1}, 0.4f));
    sampled.settings.shadow = ShadowKind::none;
    DynamicObject met = sampled;
    met.settings.gather.emittersByDirections = true;
    const FilledRoom a(lampLit(), {sampled}), b(lampLit(), {met});
    double difference = 0, sum = 0;
    forSurface(a.room.litObjects()[0], [&](std::uint32_t t, const Vec2& p, float area) {
        const float x = a.room.litObjects()[0].irradiance(t, p, true).x;
        difference += area * std::abs(b.room.litObjects()[0].irradiance(t, p, true).x - x);
        sum += area * x;
    });
    EXPECT_LT(difference / sum, 0.08);
    EXPECT_GT(difference, 0);
}

TEST(DynamicLight, IsAbsorbedAllTheSameWithAnObject) {
    const FilledRoom empty(lampLit(), {});
    const Vec3 without = absorbedFlux(empty.room, texels());
    const Vec3 emitted = Vec3(kPi * 10 * 0.36f);
    EXPECT_LT(maxComponent(glm::abs(without / emitted - 1.0f)), 0.01f);
    for (const Vec3& diffuse : {Vec3(0), Vec3(0.5f), Vec3(1)})
        for (const Vec3& place : {Vec3(0.7f, 0.8f, 1.2f), Vec3(0.7f, 0.25f, 0.8f)}) {
            const FilledRoom filled(lampLit(), {finely(bodyAt("cube", place, 0.5f, diffuse))});
            const Vec3 ratio = absorbedFlux(filled.room, texels()) / without;
            EXPECT_LT(maxComponent(glm::abs(ratio - 1.0f)), 0.02f)
                << diffuse.x << " at height " << place.y << ": " << ratio.x << " " << ratio.y;
        }
}

TEST(DynamicLight, OfAnObjectThatEmitsIsAbsorbedWhole) {
    const FilledRoom empty(lampLit(), {});
    const Vec3 without = absorbedFlux(empty.room, texels());
    const FilledRoom filled(lampLit(),
                            {finely(bodyAt("cube", {0.7f, 0.8f, 1.1f}, 0.3f, Vec3(0), {2, 4, 8}))});
    const Vec3 emitted = kPi * Vec3(2, 4, 8) * 6.0f * 0.09f;
    const Vec3 ratio = (absorbedFlux(filled.room, texels()) - without) / emitted;
    EXPECT_LT(maxComponent(glm::abs(ratio - 1.0f)), 0.03f)
        << ratio.x << " " << ratio.y << " " << ratio.z;
}

TEST(DynamicLight, OfAnObjectThatEmitsIsThrownOnByMirrors) {
    Scene scene = lampRoom(1, 0);
    scene.materials[1].diffuse = Vec3(0);  // of the wall x = 0
    scene.materials[1].mirror = Vec3(1, 1, 0.5f);
    const BakedRoom mirrored(scene, 4000);
    const RoomTexels all = makeRoomTexels(mirrored.scene, mirrored.rays, mirrored.field);
    const Vec3 without = absorbedFlux(FilledRoom(mirrored, {}).room, all);
    const FilledRoom filled(mirrored,
                            {bodyAt("cube", {0.6f, 0.8f, 1.1f}, 0.3f, Vec3(0), {4, 4, 4})});
    // What falls on the mirror is absorbed by its black side in the sum, and on the walls once
    // more.
    Vec3 onMirror(0);
    for (std::size_t i = 0; i < all.unwrap.texels.size(); ++i)
        if (all.sources.planarMirror[all.unwrap.texelChart[i]])
            onMirror += all.area[all.unwrap.texels[i]] *
                        (filled.room.irradiance().irradiance[all.unwrap.texels[i]] -
                         filled.room.roomIrradiance().irradiance[all.unwrap.texels[i]]);
    const Vec3 emitted = kPi * Vec3(4) * 6.0f * 0.09f;
    const Vec3 thrownOn = absorbedFlux(filled.room, all) - without - emitted;
    EXPECT_GT(onMirror.x, 0.2f * emitted.x);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(thrownOn[c] / (onMirror[c] * Vec3(1, 1, 0.5f)[c]), 1, 0.06f);
}

TEST(DynamicLight, OfAnObjectThatEmitsFallsOnOthersAsTraced) {
    const FilledRoom filled(
        lampLit(), {finely(bodyAt("sphere", {0.5f, 0.4f, 1}, 0.3f, Vec3(0.2f), {20, 10, 5})),
                    finely(bodyAt("cube", {1.2f, 0.5f, 1}, 0.4f))});
    // Others do not stand in the way of what bounces of its light.
    expectFacesAsTraced(filled.room, kSides, 0.08);
}

}  // namespace
}  // namespace vlf::test
