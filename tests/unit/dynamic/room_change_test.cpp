#include "vlf/dynamic/room_change.h"
#include "lit_room.h"
#include "support/analytic_scenes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

class ChangedRoom : public testing::Test {
  protected:
    /// Half of a quad is missing: its chart has texels that no surface covers.
    static const LitRoom& lit() {
        static const LitRoom room(
            [] {
                SceneBuilder b;
                b.triangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, b.material("floor", {0.5f, 0.2f, 1}));
                return b.scene();
            }(),
            Vec3(0));
        return room;
    }

    const RoomTexels& texels = lit().texels;
    IrradianceAtlas own = lit().field.atlas, light = own;
    std::vector<Vec3> radiance = lit().radiance;
    RoomChange change{texels};

    ChangedRoom() {
        for (Vec3& e : own.irradiance) e = Vec3(2);
        light = own;
        for (const std::uint32_t t : texels.unwrap.texels) radiance[t] = send(t, own);
    }

    Vec3 send(std::uint32_t t, const IrradianceAtlas& atlas) const {
        return texels.reflectance[t] * atlas.irradiance[t] / kPi;
    }

    void apply() {
        change.apply(own, light);
        change.findRadiance(own, radiance);
    }
};

TEST_F(ChangedRoom, SendsWhatTheChangedTexelsReflect) {
    const std::uint32_t t = texels.unwrap.texels[5], other = texels.unwrap.texels[9];
    change.add(t, {1, -0.5f, 0});
    change.add(t, {1, 0, 0});
    apply();
    EXPECT_EQ(light.irradiance[t], Vec3(4, 1.5f, 2));
    EXPECT_EQ(radiance[t], send(t, light));
    EXPECT_EQ(light.irradiance[other], Vec3(2));
    EXPECT_EQ(radiance[other], send(other, own));
}

TEST_F(ChangedRoom, IsItsOwnAgainWhereNothingChangesAnyMore) {
    const std::vector<Vec3> before = radiance;
    for (const std::uint32_t t : texels.unwrap.texels) change.add(t, Vec3(-1));
    apply();
    EXPECT_NE(light.irradiance, own.irradiance);
    change.clear();
    EXPECT_TRUE(change.texels().empty());
    apply();
    EXPECT_EQ(light.irradiance, own.irradiance);
    EXPECT_EQ(radiance, before);
}

TEST_F(ChangedRoom, AddsUpChangesOfTexelsBlocksGroupsAndAll) {
    const std::uint32_t t = texels.unwrap.texels[5];
    change.add(t, Vec3(2));
    EXPECT_EQ(change.texels().size(), 1u);
    change.addToAll(Vec3(0.5f));
    EXPECT_EQ(change.texels().size(), texels.unwrap.texels.size());
    change.addToBlock(texels.blockOf[t], Vec3(0.125f));
    change.addToGroup(texels.groupOf[t], Vec3(0.25f));
    apply();
    for (const std::uint32_t other : texels.unwrap.texels) {
        const bool inGroup = texels.groupOf[other] == texels.groupOf[t];
        const bool inBlock = texels.blockOf[other] == texels.blockOf[t];
        const Vec3 by(0.5f + (inGroup ? 0.25f : 0) + (inBlock ? 0.125f : 0) +
                      (other == t ? 2.0f : 0));
        EXPECT_EQ(change.of(other), by);
        // What blocks and groups have is interpolated from one to the next.
        const float seen = light.irradiance[other].x - (other == t ? 2 : 0);
        EXPECT_GE(seen, 2.5f);
        EXPECT_LE(seen, 2.875f);
        const std::uint32_t beside = other + 1;
        if (other == t || beside == t || texels.source[beside] != beside ||
            texels.unwrap.texelChart[texels.entryOf[beside]] !=
                texels.unwrap.texelChart[texels.entryOf[other]])
            continue;
        EXPECT_LT(std::abs(light.irradiance[beside].x - seen), 0.1f);
    }
    EXPECT_GT(light.irradiance[t].x, 4.5f);
    change.clear();
    apply();
    EXPECT_EQ(light.irradiance, own.irradiance);
}

TEST_F(ChangedRoom, IsSwayedLittleByTheFewTexelsOfAGroupAtAnEdge) {
    for (std::uint32_t g = 0; g < texels.groups.size(); ++g) {
        const TexelGroup& group = texels.groups[g];
        if (group.count > 16) continue;
        change.clear();
        change.addToGroup(g, Vec3(1));
        apply();
        float most = 0;
        for (const std::uint32_t t : texels.unwrap.texels)
            most = std::max(most, light.irradiance[t].x - 2);
        EXPECT_LT(most, 0.5f) << group.count;
    }
}

TEST_F(ChangedRoom, HasNoLightBelowZero) {
    for (const std::uint32_t t : texels.unwrap.texels) change.add(t, Vec3(-3, 1, -2));
    apply();
    for (const std::uint32_t t : texels.unwrap.texels) {
        EXPECT_EQ(light.irradiance[t], Vec3(0, 3, 0));
        EXPECT_EQ(radiance[t], send(t, light));
    }
}

TEST_F(ChangedRoom, TakesUncoveredTexelsAlong) {
    for (const std::uint32_t t : texels.unwrap.texels) change.add(t, Vec3(1));
    apply();
    int followers = 0;
    for (std::uint32_t t = 0; t < texels.source.size(); ++t) {
        if (texels.source[t] == kNoTexel) {
            EXPECT_EQ(light.irradiance[t], Vec3(2));
            continue;
        }
        EXPECT_EQ(light.irradiance[t], Vec3(3));
        followers += texels.source[t] != t;
    }
    EXPECT_GT(followers, 0);
}

}  // namespace
}  // namespace vlf::test
