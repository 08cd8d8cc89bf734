// Light that is found only where somebody sees it (GatherSettings::onlyVisible).

#include "baked_room.h"

#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

const BakedRoom& lampLit() {
    static const BakedRoom baked(lampRoom());
    return baked;
}

/// The same with a mirror for the wall x = 0.
const BakedRoom& mirrored() {
    static const BakedRoom baked([] {
        Scene scene = lampRoom();
        Material& wall = scene.materials[1];
        wall.diffuse = Vec3(0);
        wall.mirror = Vec3(0.9f);
        return scene;
    }());
    return baked;
}

/// A cube that casts no shadow, so that only what is seen of it needs light.
DynamicObject cube() {
    DynamicObject object = bodyAt("cube", {1, 1, 1}, 0.4f);
    object.settings.shadow = ShadowKind::none;
    return object;
}

class SeenCube {
  public:
    explicit SeenCube(const BakedRoom& baked) : filled_(baked, {cube()}) {
        for (const Vec3& side : kSides) all_.push_back(light(side));
    }

    /// Whether update() found something to do.
    bool seeFrom(const std::vector<Vec3>& eyes) {
        filled_.room.setViewers(eyes);
        return filled_.room.update();
    }

    void turn() {
        Pose pose = filled_.room.object(0).pose;
        pose.translation.x += 0.1f;
        filled_.room.setPose(0, pose);
        filled_.room.update();
        pose.translation.x -= 0.1f;
        filled_.room.setPose(0, pose);
        filled_.room.update();
    }

    /// By side -x +x -y +y -z +z: 'l' lit as if all were seen, '0' dark, '?' else.
    std::string sides() const {
        std::string s;
        for (int i = 0; i < 6; ++i) {
            const Vec3 e = light(kSides[i]);
            s += e == all_[static_cast<std::size_t>(i)] ? 'l' : e == Vec3(0) ? '0' : '?';
        }
        return s;
    }

  private:
    static constexpr Vec3 kSides[] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                      {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};

    Vec3 light(const Vec3& side) const {
        return meanIrradiance(filled_.room.litObjects()[0], side);
    }

    FilledRoom filled_;
    std::vector<Vec3> all_;
};

const Vec3 kRight(1.9f, 1, 1), kLeft(0.1f, 1, 1);

TEST(VisibleParts, AreAllWhereNobodySaysFromWhere) {
    SeenCube seen(lampLit());
    EXPECT_FALSE(seen.seeFrom({}));
    EXPECT_EQ(seen.sides(), "llllll");
}

TEST(VisibleParts, AloneAreLit) {
    SeenCube seen(lampLit());
    EXPECT_FALSE(seen.seeFrom({kRight}));  // all of it is known already
    seen.turn();
    EXPECT_EQ(seen.sides(), "0l0000");
}

TEST(VisibleParts, AreFoundWhenTheViewerMoves) {
    SeenCube seen(lampLit());
    seen.seeFrom({kRight});
    seen.turn();
    EXPECT_TRUE(seen.seeFrom({kLeft}));
    EXPECT_EQ(seen.sides(), "l00000");
    EXPECT_FALSE(seen.seeFrom({kLeft + Vec3(0, 0.1f, 0)}));
    EXPECT_TRUE(seen.seeFrom({{1.9f, 1.9f, 1.9f}}));
    EXPECT_EQ(seen.sides(), "0l0l0l");
    EXPECT_TRUE(seen.seeFrom({kLeft, kRight}));
    EXPECT_EQ(seen.sides(), "ll0000");
    EXPECT_TRUE(seen.seeFrom({}));
    EXPECT_EQ(seen.sides(), "llllll");
}

TEST(VisibleParts, AreThoseThatMirrorsShow) {
    SeenCube seen(mirrored());
    seen.seeFrom({kRight});
    seen.turn();
    EXPECT_EQ(seen.sides(), "ll0000");
}

TEST(VisibleParts, AreAllOfWhatLightsTheRoom) {
    DynamicObject object = cube();
    object.settings.shadow = ShadowKind::field;
    FilledRoom filled(lampLit(), {object});
    filled.room.setViewers(std::vector<Vec3>{kRight});
    object.pose.translation.z += 0.1f;
    filled.room.setPose(0, object.pose);
    filled.room.update();
    const FilledRoom all(lampLit(), {object});
    EXPECT_EQ(filled.room.irradiance().irradiance, all.room.irradiance().irradiance);
    EXPECT_EQ(meanIrradiance(filled.room.litObjects()[0], {-1, 0, 0}),
              meanIrradiance(all.room.litObjects()[0], {-1, 0, 0}));
}

}  // namespace
}  // namespace vlf::test
