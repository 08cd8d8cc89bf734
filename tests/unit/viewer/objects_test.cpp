#include "placed_objects.h"

#include "vlf/base/error.h"

#include <gtest/gtest.h>

namespace vlf::app {
namespace {

using test::bodyAt;
using test::PlacedObjects;

ObjectSteering push(const Vec3& by) {
    return {by, Vec2(0), false};
}

void expectNear(const Vec3& a, const Vec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-5f)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Objects, ARoomWithoutAnyCostsNothing) {
    PlacedObjects placed{Scenario()};
    Objects& objects = *placed.objects;
    EXPECT_EQ(objects.room(), nullptr);
    EXPECT_FALSE(objects.update(1, placed.eye));
    objects.toggleSubject();
    EXPECT_EQ(objects.subject(), Subject::camera);
    objects.selectNext();
    EXPECT_FALSE(objects.selected());
    objects.add(bodyAt("cube", {1, 1, 1}));
    ASSERT_NE(objects.room(), nullptr);
    EXPECT_TRUE(objects.update(1, placed.eye));
    EXPECT_EQ(objects.room()->litObjects().size(), 1u);
}

TEST(Objects, KeysMoveTheSelectedOneInItsOwnFrame) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    objects.toggleSubject();
    EXPECT_EQ(objects.subject(), Subject::object);
    EXPECT_EQ(objects.selected(), 0u);
    Pose pose = objects.now(0).pose;
    pose.rotation = glm::angleAxis(kPi / 2, Vec3(0, 1, 0));
    objects.setPose(0, pose);
    objects.steer(push({0, 0, -1}), 0.5f);
    const Vec3 way = objects.now(0).pose.translation - pose.translation;
    expectNear(glm::normalize(way), {-1, 0, 0});
    objects.steer({{0, 0, 1}, Vec2(0), true}, 0.5f / 3);
    expectNear(objects.now(0).pose.translation, pose.translation);
    expectNear(objects.now(1).pose.translation, {4.8f, 0.5f, 1});
}

TEST(Objects, TurnsAreAboutItsOwnAxesAndKeepThePlace) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    objects.select(0);
    const Pose before = objects.now(0).pose;
    for (int i = 0; i < 10; ++i) objects.steer({Vec3(0), {1, 0}, false}, 0.05f);
    const Pose turned = objects.now(0).pose;
    EXPECT_EQ(turned.translation, before.translation);
    expectNear(turned.direction({0, 1, 0}), {0, 1, 0});
    EXPECT_LT(turned.direction({1, 0, 0}).z, -0.1f) << "counter-clockwise, seen from above";
    objects.steer({Vec3(0), {0, 1}, false}, 0.5f);
    expectNear(objects.now(0).pose.direction({1, 0, 0}), turned.direction({1, 0, 0}));
    EXPECT_TRUE(isValid(objects.now(0).pose));
}

TEST(Objects, SelectionGoesRoundAndEndsWithRemoval) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    for (const std::size_t expected : {0u, 1u, 0u}) {
        objects.selectNext();
        EXPECT_EQ(objects.selected(), expected);
    }
    objects.toggleSubject();
    objects.remove(0);
    EXPECT_FALSE(objects.selected());
    EXPECT_EQ(objects.subject(), Subject::camera);
    EXPECT_EQ(placed.said, "removed cube");
    objects.update(0, placed.eye);
    ASSERT_EQ(objects.room()->litObjects().size(), 1u);
    EXPECT_EQ(objects.now(0).name, "sphere");
}

TEST(Objects, ACopyIsBesideItsOriginalUnderItsOwnName) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    objects.duplicate(0);
    ASSERT_EQ(objects.size(), 3u);
    EXPECT_EQ(objects.scenario().objects[2].object.name, "cube 2");
    EXPECT_EQ(objects.selected(), 2u);
    EXPECT_EQ(objects.now(2).model, objects.now(0).model);
    const float apart =
        glm::length(objects.now(2).pose.translation - objects.now(0).pose.translation);
    EXPECT_GT(apart, 0.1f);
    EXPECT_LT(apart, 0.3f);
    EXPECT_NE(objects.id(2), objects.id(0));
}

TEST(Objects, MotionsStandStillWhilePaused) {
    Scenario scenario{{bodyAt("cube", {1, 0.5f, 2})}};
    scenario.objects[0].motion = CircleMotion{{2, 0.5f, 2}, {0, 1, 0}, 90, true};
    PlacedObjects placed{scenario};
    Objects& objects = *placed.objects;
    EXPECT_TRUE(objects.update(1, placed.eye));
    expectNear(objects.now(0).pose.translation, {2, 0.5f, 3});
    objects.setPlaying(false);
    EXPECT_FALSE(objects.update(5, placed.eye));
    objects.setPlaying(true);
    objects.update(6, placed.eye);
    expectNear(objects.now(0).pose.translation, {3, 0.5f, 2});
}

TEST(Objects, WhoMovesOneByHandEndsItsMotion) {
    Scenario scenario{{bodyAt("cube", {1, 0.5f, 2})}};
    scenario.objects[0].motion = TurnMotion{};
    PlacedObjects placed{scenario};
    Objects& objects = *placed.objects;
    objects.update(1, placed.eye);
    objects.select(0);
    objects.steer(push({1, 0, 0}), 0.1f);
    const Pose pose = objects.now(0).pose;
    EXPECT_FALSE(moves(objects.scenario().objects[0].motion));
    EXPECT_EQ(objects.scenario().objects[0].object.pose, pose);
    objects.update(2, placed.eye);
    EXPECT_EQ(objects.now(0).pose, pose);
}

TEST(Objects, TheFirstAlongARayIsPickedUnlessTheRoomHidesIt) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    const Vec3 cube(3.8f, 0.5f, 1);
    EXPECT_EQ(objects.pick({placed.eye, cube - placed.eye}), 0u);
    EXPECT_EQ(objects.pick({cube - Vec3(0.5f, 0, 0), {1, 0, 0}}), 0u);
    EXPECT_EQ(objects.pick({Vec3(5.3f, 0.5f, 1), {-1, 0, 0}}), 1u);
    EXPECT_FALSE(objects.pick({placed.eye, placed.eye - cube}));
    EXPECT_FALSE(objects.pick({cube - Vec3(3, 0, 0), {1, 0, 0}})) << "behind a block";
    objects.setVisible(0, false);
    objects.update(0, placed.eye);
    EXPECT_EQ(objects.pick({cube - Vec3(0.5f, 0, 0), {1, 0, 0}}), 1u);
}

TEST(Objects, AnotherRoomHasThemWhereTheyAre) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    objects.select(0);
    objects.steer(push({1, 0, 0}), 1);
    objects.setVisible(1, false);
    const Pose pose = objects.now(0).pose;
    const RayScene rays(placed.room->scene);
    auto light = std::make_shared<IrradianceAtlas>(placed.room->field.atlas);
    for (Vec3& e : light->irradiance) e *= 2;
    objects.enter(placed.room, rays, light);
    EXPECT_TRUE(objects.update(0, placed.eye));
    EXPECT_EQ(objects.now(0).pose, pose);
    EXPECT_FALSE(objects.now(1).visible);
    EXPECT_EQ(objects.room()->roomIrradiance().irradiance, light->irradiance);
    objects.setLight(std::make_shared<IrradianceAtlas>(placed.room->field.atlas));
    EXPECT_TRUE(objects.update(0, placed.eye));
    EXPECT_NE(objects.room()->roomIrradiance().irradiance, light->irradiance);
}

TEST(Objects, AMaterialThatIsChangedIsAnotherModelsAlone) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    objects.duplicate(0);
    ObjectSource source = objects.scenario().objects[2].source;
    source.diffuse = Vec3(0.1f, 0.2f, 0.3f);
    objects.setSource(2, source);
    EXPECT_EQ(objects.now(2).model->scene().materials[0].diffuse, *source.diffuse);
    EXPECT_NE(objects.now(0).model, objects.now(2).model);
    source.primitive = "brick";
    EXPECT_THROW(objects.setSource(2, source), InputError);
    EXPECT_EQ(objects.scenario().objects[2].source.primitive, "cube");
}

}  // namespace
}  // namespace vlf::app
