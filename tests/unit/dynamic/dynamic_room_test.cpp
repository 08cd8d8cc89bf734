// What objects leave as it is, and what comes of objects and numbers that are out of the ordinary.

#include "vlf/dynamic/dynamic_room.h"
#include "baked_room.h"
#include "vlf/base/error.h"

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

const BakedRoom& lampLit() {
    static const BakedRoom baked(lampRoom());
    return baked;
}

const RoomTexels& texels() {
    static const RoomTexels made = makeRoomTexels(lampLit().scene, lampLit().rays, lampLit().field);
    return made;
}

void expectRoomAsItWas(const DynamicRoom& room) {
    EXPECT_EQ(room.irradiance().irradiance, room.roomIrradiance().irradiance);
    EXPECT_EQ(room.roomIrradiance().irradiance, lampLit().field.atlas.irradiance);
}

TEST(DynamicRoom, WithoutObjectsIsTheRoom) {
    FilledRoom filled(lampLit(), {});
    EXPECT_FALSE(filled.room.update());
    EXPECT_TRUE(filled.room.litObjects().empty());
    expectRoomAsItWas(filled.room);
}

TEST(DynamicRoom, IsTheSameForObjectsOutsideIt) {
    for (const Vec3& place : {Vec3(1, 1, 100), Vec3(1, 4, 1), Vec3(-1e5f, 0, 0)}) {
        const FilledRoom filled(lampLit(), {bodyAt("cube", place, 0.5f)});
        EXPECT_EQ(filled.room.litObjects().size(), 1u);
        expectRoomAsItWas(filled.room);
        EXPECT_TRUE(isAllLight(filled.room));
    }
}

TEST(DynamicRoom, IsRestoredByRemovingOrHidingAnObject) {
    FilledRoom filled(lampLit(), {bodyAt("cube", {1, 0.25f, 1}, 0.5f, {0.8f, 0.1f, 0.1f}),
                                  bodyAt("sphere", {0.5f, 1, 1.4f}, 0.3f, Vec3(0), Vec3(2))});
    DynamicRoom& room = filled.room;
    EXPECT_NE(room.irradiance().irradiance, room.roomIrradiance().irradiance);
    const std::vector<Vec3> with = room.irradiance().irradiance;
    for (const std::size_t i : {0u, 1u}) room.setVisible(i, false);
    EXPECT_TRUE(room.update());
    EXPECT_TRUE(room.litObjects().empty());
    expectRoomAsItWas(room);
    for (const std::size_t i : {0u, 1u}) room.setVisible(i, true);
    room.update();
    EXPECT_EQ(room.irradiance().irradiance, with);
    room.remove(0);
    room.remove(0);
    EXPECT_TRUE(room.update());
    EXPECT_EQ(room.size(), 0u);
    expectRoomAsItWas(room);
}

TEST(DynamicRoom, TakesNothingFromAHiddenObject) {
    DynamicObject hidden = bodyAt("cube", {0.5f, 0.5f, 0.5f}, 0.4f, Vec3(0.1f));
    hidden.visible = false;
    const DynamicObject shown = bodyAt("cube", {1, 0.25f, 1}, 0.5f);
    const FilledRoom both(lampLit(), {hidden, shown}), one(lampLit(), {shown});
    EXPECT_EQ(both.room.irradiance().irradiance, one.room.irradiance().irradiance);
    ASSERT_EQ(both.room.litNumbers().size(), 1u);
    EXPECT_EQ(both.room.litNumbers()[0], 1u);
}

TEST(DynamicRoom, IsDarkWhereAnObjectSwallowsItsLamp) {
    const FilledRoom filled(lampLit(), {bodyAt("cube", {1, 1.95f, 1}, 0.8f, Vec3(0.5f))});
    EXPECT_TRUE(isAllLight(filled.room));
    const float before = meanIrradiance(texels(), filled.room.roomIrradiance()).x;
    const float left = meanIrradiance(texels(), filled.room.irradiance()).x;
    EXPECT_LT(left, 0.1f * before);
    const Vec3 on = meanIrradiance(filled.room.litObjects()[0], {0, -1, 0});
    EXPECT_LT(on.x, 0.1f * before);
    RecordProperty("left", std::to_string(left / before));
}

TEST(DynamicRoom, StandsObjectsAsBigAsItIsAndBigger) {
    const auto expectLight = [](const char* name, float scale) {
        DynamicObject object = bodyAt(name, Vec3(1), scale);
        object.settings.directSamples = 1;
        const FilledRoom filled(lampLit(), {object});
        EXPECT_TRUE(isAllLight(filled.room)) << name << " of " << scale;
    };
    expectLight("cube", 1.999f);
    expectLight("cube", 2);
    expectLight("cube", 1000);
    expectLight("sphere", 2.5f);
    expectLight("knot", 3);
}

TEST(DynamicRoom, StandsObjectsTooSmallToSee) {
    const FilledRoom filled(lampLit(), {bodyAt("cube", Vec3(1), 1e-5f)});
    EXPECT_TRUE(isAllLight(filled.room));
    double change = 0, all = 0;
    for (const std::uint32_t t : texels().unwrap.texels) {
        const Vec3& without = filled.room.roomIrradiance().irradiance[t];
        change += luminance(glm::abs(filled.room.irradiance().irradiance[t] - without));
        all += luminance(without);
    }
    EXPECT_LT(change / all, 1e-5);
    EXPECT_GT(meanIrradiance(filled.room.litObjects()[0], {0, 1, 0}).x, 0);
}

TEST(DynamicRoom, StandsObjectsInTheSamePlace) {
    const DynamicObject cube = bodyAt("cube", {1, 0.5f, 1}, 0.5f);
    const FilledRoom two(lampLit(), {cube, cube}), one(lampLit(), {cube});
    EXPECT_TRUE(isAllLight(two.room));
    // Light is not taken out twice.
    const float taken = meanIrradiance(texels(), one.room.irradiance()).x;
    EXPECT_NEAR(meanIrradiance(texels(), two.room.irradiance()).x / taken, 1, 0.05f);
}

TEST(DynamicRoom, LightsObjectsByOneAnotherAtOnce) {
    const auto face = [](ShadowKind shadow, float albedo) {
        DynamicObject left = bodyAt("cube", {0.8f, 0.5f, 1}, 0.3f, Vec3(albedo));
        DynamicObject right = bodyAt("cube", {1.2f, 0.5f, 1}, 0.3f, Vec3(albedo));
        left.settings.shadow = right.settings.shadow = shadow;
        const FilledRoom filled(lampLit(), {left, right});
        return std::pair(meanIrradiance(filled.room.litObjects()[0], {1, 0, 0}).x,
                         meanIrradiance(filled.room.litObjects()[1], {-1, 0, 0}).x);
    };
    for (const ShadowKind shadow : {ShadowKind::none, ShadowKind::soft, ShadowKind::field}) {
        const auto [leftDark, rightDark] = face(shadow, 0);
        const auto [leftBright, rightBright] = face(shadow, 0.9f);
        EXPECT_GT(leftBright, 1.2f * leftDark);
        EXPECT_GT(rightBright, 1.2f * rightDark);
        EXPECT_NEAR(leftBright / rightBright, 1, 0.05f);  // but for later bounces
    }
}

TEST(DynamicRoom, LightsAModelBySizeInTheWorldWhateverItsOwnScale) {
    const DynamicObject cube = bodyAt("cube", {0.8f, 0.3f, 1.1f}, 0.4f);
    const FilledRoom plain(lampLit(), {cube});
    for (const float scale : {1e-3f, 1e3f}) {
        Scene scene = cube.model->scene();
        for (Vec3& p : scene.positions) p *= scale;
        DynamicObject other = cube;
        other.model = std::make_shared<ObjectModel>(scene);
        other.pose.scale /= scale;
        const FilledRoom scaled(lampLit(), {other});
        for (const Vec3& normal : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)}) {
            const Vec3 expected = meanIrradiance(plain.room.litObjects()[0], normal);
            const Vec3 found = meanIrradiance(scaled.room.litObjects()[0], normal);
            EXPECT_NEAR(found.x / expected.x, 1, 0.01) << scale;
        }
        EXPECT_NEAR(meanIrradiance(texels(), scaled.room.irradiance()).x /
                        meanIrradiance(texels(), plain.room.irradiance()).x,
                    1, 0.002);
    }
}

TEST(DynamicRoom, IsTheSameAtEveryScale) {
    const auto light = [](float size) {
        const BakedRoom baked(lampRoom(size));
        const FilledRoom filled(
            baked, {bodyAt("cube", size * Vec3(0.8f, 0.25f, 1.1f), 0.5f * size, Vec3(0.3f))});
        const RoomTexels room = makeRoomTexels(baked.scene, baked.rays, baked.field);
        const LitObject& cube = filled.room.litObjects()[0];
        return std::vector<float>{
            meanIrradiance(room, filled.room.irradiance()).x, meanIrradiance(cube, {0, 1, 0}).x,
            meanIrradiance(cube, {1, 0, 0}).x, meanIrradiance(cube, {-1, 0, 0}).x};
    };
    const std::vector<float> expected = light(1);
    for (const float size : {1e-3f, 1e3f}) {
        const std::vector<float> found = light(size);
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(found[i] / expected[i], 1, 0.01f) << size << " " << i;
    }
}

/// Calls change(room), which is to fail, and expects the room to be what it was.
template <class Change>
void expectRefused(DynamicRoom& room, const Change& change) {
    const DynamicObject before = room.object(0);
    EXPECT_THROW(change(), InputError);
    EXPECT_EQ(room.size(), 1u);
    EXPECT_EQ(room.object(0).pose, before.pose);
    EXPECT_EQ(room.object(0).settings, before.settings);
    EXPECT_EQ(room.object(0).model, before.model);
    EXPECT_FALSE(room.update());
}

TEST(DynamicRoom, RefusesPosesThatAreNone) {
    FilledRoom filled(lampLit(), {bodyAt("cube", Vec3(1), 0.3f)});
    DynamicRoom& room = filled.room;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const Quat none(1, 0, 0, 0);
    for (const Pose& pose :
         {Pose{Vec3(nan), none, 1}, Pose{Vec3(infinity, 0, 0), none, 1}, Pose{Vec3(1), none, 0},
          Pose{Vec3(1), none, -1}, Pose{Vec3(1), none, nan}, Pose{Vec3(1), none, infinity},
          Pose{Vec3(1), Quat(2, 0, 0, 0), 1}, Pose{Vec3(1), Quat(0, 0, 0, 0), 1},
          Pose{Vec3(1), Quat(nan, 0, 0, 0), 1}}) {
        expectRefused(room, [&] { room.setPose(0, pose); });
        DynamicObject object = room.object(0);
        object.pose = pose;
        expectRefused(room, [&] { room.add(object); });
    }
}

TEST(DynamicRoom, RefusesSettingsOutOfRange) {
    FilledRoom filled(lampLit(), {bodyAt("cube", Vec3(1), 0.3f)});
    DynamicRoom& room = filled.room;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto refused = [&](const auto& spoil) {
        ObjectSettings settings = room.object(0).settings;
        spoil(settings);
        expectRefused(room, [&] { room.setSettings(0, settings); });
    };
    for (const int n : {0, -1, 1025}) refused([&](auto& s) { s.directSamples = n; });
    for (const int n : {-1, 4}) refused([&](auto& s) { s.gather.subdivision = n; });
    for (const int n : {0, -3}) refused([&](auto& s) { s.gather.step = n; });
    for (const float f : {-1.0f, nan}) refused([&](auto& s) { s.gather.texelSize = f; });
    for (const int n : {0, -1, 100, 512}) refused([&](auto& s) { s.gather.lines = n; });
    refused([&](auto& s) { s.gather.importanceSamples = -1; });
    for (const int n : {0, 6}) refused([&](auto& s) { s.prt.order = n; });
    for (const int n : {15, 8193}) refused([&](auto& s) { s.hard.mapSize = n; });
    for (const float f : {-0.1f, 1.1f, nan}) refused([&](auto& s) { s.hard.opacity = f; });
    expectRefused(room, [&] { room.setModel(0, nullptr); });
}

TEST(DynamicRoom, KeepsItsLightWhenAnObjectCannotBeLit) {
    FilledRoom filled(lampLit(), {bodyAt("cube", Vec3(1), 0.3f)});
    DynamicRoom& room = filled.room;
    const std::vector<Vec3> before = room.irradiance().irradiance;
    DynamicObject other = bodyAt("cube", Vec3(0.5f), 0.3f);
    other.settings.gather.texelSize = 1e-7f;
    room.add(other);
    Pose pose = room.object(0).pose;
    pose.scale = 0.4f;  // has the first one prepared anew, too
    room.setPose(0, pose);
    for (int again = 0; again < 2; ++again) {
        EXPECT_THROW(room.update(), InputError);
        EXPECT_EQ(room.irradiance().irradiance, before);
        ASSERT_EQ(room.litObjects().size(), 1u);
        EXPECT_TRUE(isAllLight(room));
    }
    other.settings.gather.texelSize = 0;
    room.setSettings(1, other.settings);
    EXPECT_TRUE(room.update());
    DynamicObject first = room.object(0);
    const FilledRoom fresh(lampLit(), {first, other});
    EXPECT_EQ(room.irradiance().irradiance, fresh.room.irradiance().irradiance);
}

}  // namespace
}  // namespace vlf::test
