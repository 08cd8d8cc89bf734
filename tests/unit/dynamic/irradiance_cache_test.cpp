// Light that is kept for objects that come by again (GatherSettings::cache).

#include "vlf/dynamic/irradiance_cache.h"

#include "baked_room.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

const BakedRoom& lampLit() {
    static const BakedRoom baked(lampRoom());
    return baked;
}

DynamicObject cachingCube(const Vec3& place) {
    DynamicObject cube = bodyAt("cube", place, 0.3f);
    cube.settings.shadow = ShadowKind::none;
    cube.settings.gather.cache = true;
    return cube;
}

void moveTo(DynamicRoom& room, std::size_t i, const Vec3& place) {
    Pose pose = room.object(i).pose;
    pose.translation = place;
    room.setPose(i, pose);
    room.update();
}

std::vector<Vec3> lightOn(const DynamicRoom& room, std::size_t i) {
    return room.litObjects()[i].atlas->irradiance;
}

/// Relative to the greatest of `b`.
float greatestDifference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    float most = 0, difference = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        most = std::max(most, maxComponent(b[i]));
        difference = std::max(difference, maxComponent(glm::abs(a[i] - b[i])));
    }
    return difference / most;
}

TEST(IrradianceCache, HoldsTheLastOfACellAndANormal) {
    IrradianceCache cache;
    cache.begin(0.1f);
    const Vec3 up(0, 1, 0);
    EXPECT_FALSE(cache.find(Vec3(0.51f), up));
    cache.store(Vec3(0.51f), up, Vec3(1));
    cache.store(Vec3(0.52f), up, Vec3(2));
    EXPECT_EQ(cache.find(Vec3(0.58f), up), Vec3(2));
    EXPECT_FALSE(cache.find(Vec3(0.61f), up));
    EXPECT_FALSE(cache.find(Vec3(0.51f), -up));
    cache.begin(0.1f);
    EXPECT_TRUE(cache.find(Vec3(0.51f), up));
    cache.begin(0.2f);
    EXPECT_FALSE(cache.find(Vec3(0.51f), up)) << "cells are others";
}

TEST(IrradianceCache, BringsBackTheLightOfAPlace) {
    const FilledRoom fresh(lampLit(), {cachingCube({0.8f, 0.5f, 1})});
    FilledRoom moved(lampLit(), {cachingCube({0.8f, 0.5f, 1})});
    moveTo(moved.room, 0, {1.2f, 0.9f, 0.7f});
    EXPECT_GT(greatestDifference(lightOn(moved.room, 0), lightOn(fresh.room, 0)), 0.1f);
    moveTo(moved.room, 0, {0.8f, 0.5f, 1});
    EXPECT_LT(greatestDifference(lightOn(moved.room, 0), lightOn(fresh.room, 0)), 0.05f);
}

TEST(IrradianceCache, NoticesThatAnotherObjectHasMoved) {
    DynamicObject red = bodyAt("cube", {1.25f, 0.5f, 1}, 0.5f, {0.9f, 0.1f, 0.1f});
    FilledRoom moved(lampLit(), {cachingCube({0.8f, 0.5f, 1}), red});
    moveTo(moved.room, 1, {1.25f, 1.4f, 1.6f});
    red.pose.translation = {1.25f, 1.4f, 1.6f};
    const FilledRoom fresh(lampLit(), {cachingCube({0.8f, 0.5f, 1}), red});
    EXPECT_EQ(greatestDifference(lightOn(moved.room, 0), lightOn(fresh.room, 0)), 0);
}

TEST(IrradianceCache, KeepsTheLightThatOthersHaveInTheEnd) {
    // Of the neighbour only a guess is known at first; a room of one lamp is far from even.
    DynamicObject cube = cachingCube({0.8f, 0.5f, 1});
    const DynamicObject other = bodyAt("cube", {1.15f, 0.5f, 1}, 0.4f, Vec3(0.9f));
    FilledRoom kept(lampLit(), {cube, other});
    const std::vector<Vec3> before = lightOn(kept.room, 0);
    // An object too small to matter has all lit again, by what is kept where it is.
    kept.room.add(bodyAt("cube", {0.2f, 1.8f, 0.2f}, 0.005f));
    kept.room.update();
    moveTo(kept.room, 2, {0.21f, 1.8f, 0.2f});
    moveTo(kept.room, 0, {0.8001f, 0.5f, 1});
    EXPECT_LT(greatestDifference(lightOn(kept.room, 0), before), 0.05f);
}

TEST(IrradianceCache, ForgetsWhatOtherSettingsHaveGathered) {
    DynamicObject cube = cachingCube({0.8f, 0.5f, 1});
    cube.settings.gather.emittersByDirections = true;
    FilledRoom changed(lampLit(), {cube});
    cube.settings.gather.emittersByDirections = false;
    changed.room.setSettings(0, cube.settings);
    changed.room.update();
    const FilledRoom fresh(lampLit(), {cube});
    EXPECT_EQ(greatestDifference(lightOn(changed.room, 0), lightOn(fresh.room, 0)), 0);
}

}  // namespace
}  // namespace vlf::test
