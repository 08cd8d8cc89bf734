// Light that is found only where somebody sees it (GatherSettings::onlyVisible).

#include "baked_room.h"

#include <string>
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

/// The same with a mirror for the opposite wall, too.
const BakedRoom& twiceMirrored() {
    static const BakedRoom baked([] {
        Scene scene = lampRoom();
        Material mirror;
        mirror.diffuse = Vec3(0);
        mirror.mirror = Vec3(0.9f);
        scene.materials.push_back(mirror);
        const auto last = static_cast<std::uint32_t>(scene.materials.size() - 1);
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
            if (std::abs(geometricNormal(scene, t).x) > 0.9f) scene.triangles[t].material = last;
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
    explicit SeenCube(const BakedRoom& baked) : rays_(baked.rays), filled_(baked, {cube()}) {
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

    /// By side -x +x -y +y -z +z: 'l' lit as if all were seen, '0' as the room is in the mean for
    /// want of better, '?' else.
    std::string sides() const {
        std::string s;
        const RoomTexels texels = makeRoomTexels(filled_.room.scene(), rays_, filled_.room.field());
        const Vec3 mean = meanIrradiance(texels, filled_.room.roomIrradiance());
        for (int i = 0; i < 6; ++i) {
            const Vec3 e = light(kSides[i]);
            s += e == all_[static_cast<std::size_t>(i)]            ? 'l'
                 : maxComponent(glm::abs(e / mean - 1.0f)) < 1e-4f ? '0'
                                                                   : '?';
        }
        return s;
    }

  private:
    static constexpr Vec3 kSides[] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                      {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};

    Vec3 light(const Vec3& side) const {
        return meanIrradiance(filled_.room.litObjects()[0], side);
    }

    const RayScene& rays_;
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
    EXPECT_FALSE(seen.seeFrom({kLeft + Vec3(0, 0.05f, 0)}));
    EXPECT_TRUE(seen.seeFrom({{1.9f, 1.9f, 1.9f}}));
    EXPECT_EQ(seen.sides(), "0l0l0l");
    EXPECT_TRUE(seen.seeFrom({kLeft, kRight}));
    EXPECT_EQ(seen.sides(), "ll0000");
    EXPECT_TRUE(seen.seeFrom({}));
    EXPECT_EQ(seen.sides(), "llllll");
}

TEST(VisibleParts, AreThoseThatMirrorsShow) {
    SeenCube seen(mirrored());
    seen.seeFrom({{0.7f, 1, 1}});
    seen.turn();
    EXPECT_EQ(seen.sides(), "l00000");
    // The mirror shows the far side to who stands on the other.
    SeenCube other(mirrored());
    other.seeFrom({kRight});
    other.turn();
    EXPECT_EQ(other.sides().substr(0, 2), "ll");
}

TEST(VisibleParts, AreAllBetweenTwoMirrors) {
    // Its lower side shows in the mirror x = 2 as x = 0 shows it, not to the eye or in one of them.
    const float tilt = 0.31f;
    DynamicObject object = cube();
    object.pose.rotation = glm::angleAxis(tilt, Vec3(0, 0, 1));
    FilledRoom filled(twiceMirrored(), {object});
    filled.room.setViewers(std::vector<Vec3>{{1, 1.9f, 1}});
    object.pose.translation.z += 0.01f;
    filled.room.setPose(0, object.pose);
    filled.room.update();
    const FilledRoom all(twiceMirrored(), {object});
    const Vec3 below = object.pose.direction({0, -1, 0});
    EXPECT_EQ(meanIrradiance(filled.room.litObjects()[0], below),
              meanIrradiance(all.room.litObjects()[0], below));
}

TEST(VisibleParts, AreAllBesideAnObjectThatMirrors) {
    DynamicObject mirror = bodyAt("cube", {0.4f, 1, 1}, 0.2f);
    Scene scene = mirror.model->scene();
    scene.materials.front().mirror = Vec3(0.9f);
    scene.materials.front().diffuse = Vec3(0);
    mirror.model = std::make_shared<ObjectModel>(std::move(scene));
    DynamicObject object = cube();
    FilledRoom filled(lampLit(), {object, mirror});
    filled.room.setViewers(std::vector<Vec3>{kRight});
    object.pose.translation.z += 0.1f;
    filled.room.setPose(0, object.pose);
    filled.room.update();
    const FilledRoom all(lampLit(), {object, mirror});
    EXPECT_EQ(meanIrradiance(filled.room.litObjects()[0], {-1, 0, 0}),
              meanIrradiance(all.room.litObjects()[0], {-1, 0, 0}));
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
