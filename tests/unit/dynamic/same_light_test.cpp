// The light of a room with objects depends on where these are, and on nothing else.

#include "baked_room.h"
#include "vlf/base/parallel.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

const BakedRoom& lampLit() {
    static const BakedRoom baked(lampRoom());
    return baked;
}

/// With few samples: noise is the same, too.
DynamicObject coarsely(DynamicObject object) {
    object.settings.directSamples = 1;
    return object;
}

/// Everything that is lit, in a row.
std::vector<Vec3> allLight(const DynamicRoom& room) {
    std::vector<Vec3> all = room.irradiance().irradiance;
    for (const LitObject& object : room.litObjects()) {
        all.insert(all.end(), object.vertexIrradiance.begin(), object.vertexIrradiance.end());
        if (object.atlas)
            all.insert(all.end(), object.atlas->irradiance.begin(), object.atlas->irradiance.end());
    }
    return all;
}

std::size_t differences(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
    return count;
}

DynamicRoom someObjects() {
    DynamicRoom room(lampLit().scene, lampLit().rays, lampLit().field);
    room.add(coarsely(bodyAt("cube", {0.7f, 0.25f, 1.1f}, 0.5f)));
    room.add(coarsely(bodyAt("knot", {1.3f, 0.6f, 0.8f}, 0.6f, {0.2f, 0.7f, 0.3f})));
    DynamicObject soft = coarsely(bodyAt("sphere", {1, 1.2f, 1.5f}, 0.3f));
    soft.settings.shadow = ShadowKind::soft;
    soft.settings.gather.points = GatherPoints::vertices;
    room.add(soft);
    return room;
}

TEST(SameLight, ForAnyNumberOfThreads) {
    const auto lightOn = [](int threads) {
        const ThreadLimit limit(threads);
        DynamicRoom room = someObjects();
        room.add(coarsely(bodyAt("sphere", {0.4f, 0.8f, 0.5f}, 0.2f, Vec3(0), Vec3(3))));
        room.update();
        return allLight(room);
    };
    const std::vector<Vec3> one = lightOn(1);
    EXPECT_EQ(differences(one, lightOn(2)), 0u);
    EXPECT_EQ(differences(one, lightOn(7)), 0u);
}

TEST(SameLight, WhateverPosesCameBefore) {
    DynamicRoom fresh = someObjects();
    fresh.update();
    DynamicRoom moved = someObjects();
    RandomStream random(1, 0);
    for (int step = 0; step < 3; ++step) {
        for (std::size_t i = 0; i < moved.size(); ++i) {
            Pose pose = moved.object(i).pose;
            pose.translation = 0.3f + 1.4f * Vec3(random.next2(), random.next());
            pose.rotation = glm::normalize(
                glm::quat_cast(sampleUniformRotation(Vec3(random.next2(), random.next()))));
            moved.setPose(i, pose);
        }
        moved.update();
    }
    for (std::size_t i = 0; i < moved.size(); ++i) moved.setPose(i, fresh.object(i).pose);
    moved.update();
    EXPECT_EQ(differences(allLight(fresh), allLight(moved)), 0u);
}

TEST(SameLight, WhenASmallObjectFarAwayHasMovedAndComeBack) {
    // Too small to matter to the others, which do not look about for it.
    const DynamicObject speck = coarsely(bodyAt("cube", {0.2f, 1.8f, 0.2f}, 0.005f));
    DynamicRoom fresh = someObjects();
    fresh.add(speck);
    fresh.update();
    DynamicRoom moved = someObjects();
    moved.add(speck);
    moved.update();
    Pose away = speck.pose;
    away.translation.x += 0.02f;
    for (const Pose& pose : {away, speck.pose}) {
        moved.setPose(3, pose);
        moved.update();
    }
    EXPECT_EQ(differences(allLight(fresh), allLight(moved)), 0u);
}

TEST(SameLight, OfObjectsWithoutShadowsWhateverCameBefore) {
    // Each sees the other.
    const auto add = [](DynamicRoom& room) {
        for (const float x : {0.8f, 1.2f}) {
            DynamicObject cube = bodyAt("cube", {x, 0.5f, 1}, 0.3f, Vec3(0.9f));
            cube.settings.shadow = ShadowKind::none;
            room.add(cube);
        }
    };
    DynamicRoom fresh(lampLit().scene, lampLit().rays, lampLit().field);
    add(fresh);
    fresh.update();
    DynamicRoom moved(lampLit().scene, lampLit().rays, lampLit().field);
    add(moved);
    for (const float height : {1.0f, 0.5f}) {
        Pose pose = moved.object(0).pose;
        pose.translation.y = height;
        moved.setPose(0, pose);
        moved.update();
    }
    EXPECT_EQ(differences(allLight(fresh), allLight(moved)), 0u);
}

TEST(SameLight, WhereAnObjectWithoutShadowStood) {
    DynamicObject cube = bodyAt("cube", {1, 0.15f, 1}, 0.3f);
    cube.settings.shadow = ShadowKind::none;
    FilledRoom filled(lampLit(), {cube});
    ASSERT_GT(
        differences(filled.room.irradiance().irradiance, filled.room.roomIrradiance().irradiance),
        0u)
        << "the floor under it is not seen";
    cube.pose.translation = Vec3(1);
    filled.room.setPose(0, cube.pose);
    filled.room.update();
    EXPECT_EQ(
        differences(filled.room.irradiance().irradiance, filled.room.roomIrradiance().irradiance),
        0u);
}

TEST(SameLight, WhenNothingHasLookedAtTheRoomForAWhile) {
    const auto set = [](DynamicRoom& room, std::size_t i, Shading shading, ShadowKind shadow) {
        ObjectSettings settings = room.object(i).settings;
        settings.shading = shading;
        settings.shadow = shadow;
        room.setSettings(i, settings);
    };
    FilledRoom room(lampLit(), {coarsely(bodyAt("cube", {0.7f, 0.25f, 1.1f}, 0.5f)),
                                coarsely(bodyAt("cube", {1.2f, 0.4f, 0.8f}, 0.3f))});
    for (std::size_t i = 0; i < 2; ++i) set(room.room, i, Shading::flat, ShadowKind::none);
    room.room.update();
    set(room.room, 1, Shading::gather, ShadowKind::none);
    room.room.update();
    FilledRoom fresh(lampLit(), {room.room.object(0), room.room.object(1)});
    EXPECT_EQ(differences(allLight(fresh.room), allLight(room.room)), 0u);
}

TEST(SameLight, WhateverSettingsCameBefore) {
    RandomStream random(2, 0);
    const auto pick = [&](int count) { return static_cast<int>(random.next() * count) % count; };
    DynamicRoom moved(lampLit().scene, lampLit().rays, lampLit().field);
    const DynamicObject cube = coarsely(bodyAt("cube", {0.7f, 0.25f, 1.1f}, 0.5f));
    const DynamicObject other =
        coarsely(bodyAt("cube", {1.2f, 0.4f, 0.8f}, 0.3f, {0.1f, 0.6f, 0.2f}));
    moved.add(cube);
    moved.add(other);
    constexpr Shading kShadings[] = {Shading::flat, Shading::lights, Shading::gather, Shading::prt};
    constexpr ShadowKind kShadows[] = {ShadowKind::none, ShadowKind::hard, ShadowKind::soft,
                                       ShadowKind::field};
    for (int step = 0; step < 40; ++step) {
        const auto i = static_cast<std::size_t>(pick(2));
        ObjectSettings settings = moved.object(i).settings;
        settings.shading = kShadings[pick(4)];
        settings.shadow = kShadows[pick(4)];
        settings.directSamples = 1 + pick(2);
        settings.prt.order = 1 + pick(2);
        settings.gather.points = pick(2) ? GatherPoints::texels : GatherPoints::vertices;
        settings.gather.subdivision = pick(2);
        settings.gather.lines = pick(2) ? 33 : 129;
        settings.gather.step = 1 + pick(2);
        settings.gather.emittersByDirections = pick(2) == 1;
        moved.setSettings(i, settings);
        moved.update();
        ASSERT_TRUE(isAllLight(moved)) << step;
    }
    moved.setSettings(0, cube.settings);
    moved.setSettings(1, other.settings);
    moved.update();
    const FilledRoom fresh(lampLit(), {cube, other});
    EXPECT_EQ(differences(allLight(fresh.room), allLight(moved)), 0u);
}

}  // namespace
}  // namespace vlf::test
