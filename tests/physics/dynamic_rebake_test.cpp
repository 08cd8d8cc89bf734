// What objects change in a room against the same room baked again with them in it.

#include "posed_truth.h"
#include "vlf/dynamic/rebake.h"

#include <algorithm>
#include <functional>
#include <string>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

const BakedRoom& lampLit() {
    static const BakedRoom baked(lampRoom(), 6000);
    return baked;
}

RoomLightError errorOf(const DynamicRoom& room) {
    BakeParams params = paramsOf(room.field().record);
    Progress progress;
    return compareRoomLight(room, rebake(room, params, progress).field);
}

void expectNear(const DynamicRoom& room, double changeError, const std::string& what) {
    const RoomLightError error = errorOf(room);
    EXPECT_GT(error.changedTexels, 100u) << what;
    EXPECT_LT(error.changeError, changeError) << what << ", noise " << error.noise;
    ::testing::Test::RecordProperty(what, std::to_string(error.changeError));
}

TEST(DynamicRebake, ShadowAndBouncedLightOfACubeOnTheFloor) {
    const FilledRoom filled(lampLit(), {bodyAt("cube", {0.8f, 0.25f, 1.1f}, 0.5f)});
    expectNear(filled.room, 0.12, "grey cube");
}

TEST(DynamicRebake, ShadowAndBouncedLightOfACubeInTheAir) {
    DynamicObject cube = bodyAt("cube", {0.7f, 0.7f, 1.1f}, 0.5f, {0.8f, 0.1f, 0.1f});
    cube.pose.rotation = glm::normalize(Quat(0.9f, 0.2f, 0.3f, -0.1f));
    const FilledRoom filled(lampLit(), {cube});
    expectNear(filled.room, 0.12, "red cube in the air");
}

TEST(DynamicRebake, TwoBodiesOneUponTheOther) {
    const FilledRoom filled(lampLit(), {bodyAt("cube", {1.2f, 0.25f, 1.1f}, 0.5f, Vec3(0.1f)),
                                        bodyAt("sphere", {1.2f, 0.7f, 1.1f}, 0.4f)});
    expectNear(filled.room, 0.12, "two bodies");
}

/// Change of irradiance over the texels of the room that `wanted` picks, relative to what they had.
Vec3 changeOf(const DynamicRoom& room, const std::function<bool(const LightReceiver&)>& wanted) {
    const RoomTexels texels = makeRoomTexels(lampLit().scene, lampLit().rays, lampLit().field);
    Vec3 change(0), before(0);
    for (std::size_t i = 0; i < texels.unwrap.texels.size(); ++i) {
        const LightReceiver r = texelReceiver(lampLit().scene, texels.unwrap, i);
        if (!wanted(r)) continue;
        const std::uint32_t t = texels.unwrap.texels[i];
        before += texels.area[t] * room.roomIrradiance().irradiance[t];
        change += texels.area[t] *
                  (room.irradiance().irradiance[t] - room.roomIrradiance().irradiance[t]);
    }
    return change / before;
}

bool isFloorBeside(const LightReceiver& r) {
    return r.normal.y > 0.9f && std::abs(r.centre.z - 1) < 0.25f && r.centre.x > 0.66f &&
           r.centre.x < 0.8f;
}
bool isWallBeside(const LightReceiver& r) {
    return r.normal.x > 0.9f && std::abs(r.centre.z - 1) < 0.25f && r.centre.y < 0.5f;
}

/// A cube on the floor beside the wall x = 0, its right side in the light.
FilledRoom cubeBesideTheWall(const Vec3& diffuse) {
    return FilledRoom(lampLit(), {bodyAt("cube", {0.4f, 0.25f, 1}, 0.5f, diffuse)});
}

TEST(DynamicBleeding, RedTintsTheFloorAndTheWallBeside) {
    const FilledRoom red = cubeBesideTheWall({0.9f, 0.05f, 0.05f});
    const Vec3 floor = changeOf(red.room, isFloorBeside), wall = changeOf(red.room, isWallBeside);
    EXPECT_GT(floor.x - floor.y, 0.02f);
    EXPECT_GT(wall.x - wall.y, 0.02f);
    EXPECT_NEAR(floor.z, floor.y, 1e-4f);
    EXPECT_NEAR(wall.z, wall.y, 1e-4f);
}

TEST(DynamicBleeding, WhiteDoesNotTint) {
    const FilledRoom white = cubeBesideTheWall(Vec3(0.9f));
    for (const auto& wanted : {isFloorBeside, isWallBeside}) {
        const Vec3 change = changeOf(white.room, wanted);
        EXPECT_NEAR(change.x, change.y, 1e-4f);
        EXPECT_NEAR(change.x, change.z, 1e-4f);
    }
    EXPECT_GT(changeOf(white.room, isFloorBeside).x, 0);
}

TEST(DynamicBleeding, BlackOnlyTakes) {
    const FilledRoom black = cubeBesideTheWall(Vec3(0));
    const auto& with = black.room.irradiance().irradiance;
    const auto& without = black.room.roomIrradiance().irradiance;
    for (std::size_t t = 0; t < with.size(); ++t) EXPECT_LE(with[t].x, without[t].x);
}

}  // namespace
}  // namespace vlf::test
