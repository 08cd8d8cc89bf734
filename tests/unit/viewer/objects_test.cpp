#include "placed_objects.h"

#include "vlf/base/error.h"
#include "vlf/dynamic/scenario_file.h"

#include <gtest/gtest.h>

namespace vlf::app {
namespace {

using test::appearing;
using test::bodyAt;
using test::PlacedObjects;
using test::unlightable;

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
    EXPECT_FALSE(placed.update(1));
    objects.toggleSubject();
    EXPECT_EQ(objects.subject(), Subject::camera);
    objects.selectNext();
    EXPECT_FALSE(objects.selected());
    objects.add(bodyAt("cube", {1, 1, 1}));
    ASSERT_NE(objects.room(), nullptr);
    EXPECT_TRUE(placed.update(1));
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
    const Pose tipped = objects.now(0).pose;
    expectNear(tipped.direction({1, 0, 0}), turned.direction({1, 0, 0}));
    EXPECT_GT(glm::dot(tipped.direction({0, 1, 0}), turned.direction({0, 0, 1})), 0.1f)
        << "counter-clockwise, seen from the tip of X";
    objects.steer({Vec3(0), {1, 0}, false}, 0.5f);
    expectNear(objects.now(0).pose.direction({0, 1, 0}), tipped.direction({0, 1, 0}));
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
    placed.update(0);
    ASSERT_EQ(objects.room()->litObjects().size(), 1u);
    EXPECT_EQ(objects.now(0).name, "sphere");
}

TEST(Objects, WhereNoneIsSelectedKeysMoveTheCamera) {
    PlacedObjects placed;
    placed.objects->toggleSubject();
    placed.objects->select({});
    EXPECT_EQ(placed.objects->subject(), Subject::camera);
    EXPECT_EQ(placed.said, "no object selected");
}

TEST(Objects, TheirLightIsFoundAsTheEyeSeesThem) {
    Scenario scenario{{bodyAt("cube", {4.3f, 0.5f, 1})}};
    scenario.objects[0].object.settings.shading = Shading::gather;
    PlacedObjects placed{scenario};
    placed.objects->select(0);
    placed.objects->steer(push({1, 0, 0}), 0.1f);
    EXPECT_TRUE(placed.update(1));
    EXPECT_FALSE(placed.update(1));
    placed.eye.z = 2.5f;
    EXPECT_TRUE(placed.update(2)) << "its other side";
}

TEST(Objects, ANewOneIsPlacedBeforeTheWall) {
    PlacedObjects placed;
    const Ray ray{{2.5f, 5, 1}, {2, 0, 0}};
    const float wall = 2 * placed.rays.closest(ray).t;
    expectNear(placed.objects->placeAlong(ray, 0.1f), ray.origin + Vec3(0.4f, 0, 0));
    const float away = placed.objects->placeAlong(ray, 1.0f).x - ray.origin.x;
    EXPECT_GT(wall, 2.9f);
    EXPECT_LT(away, wall);
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
    EXPECT_TRUE(placed.update(1));
    expectNear(objects.now(0).pose.translation, {2, 0.5f, 3});
    objects.setPlaying(false);
    EXPECT_FALSE(placed.update(5));
    objects.setPlaying(true);
    placed.update(6);
    expectNear(objects.now(0).pose.translation, {3, 0.5f, 2});
}

TEST(Objects, WhoMovesOneByHandEndsItsMotion) {
    Scenario scenario{{bodyAt("cube", {1, 0.5f, 2})}};
    scenario.objects[0].motion = TurnMotion{};
    PlacedObjects placed{scenario};
    Objects& objects = *placed.objects;
    placed.update(1);
    objects.select(0);
    objects.steer(push({1, 0, 0}), 0.1f);
    const Pose pose = objects.now(0).pose;
    EXPECT_FALSE(moves(objects.scenario().objects[0].motion));
    EXPECT_EQ(objects.scenario().objects[0].object.pose, pose);
    placed.update(2);
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
    placed.update(0);
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
    EXPECT_TRUE(placed.update(0));
    EXPECT_EQ(objects.now(0).pose, pose);
    EXPECT_FALSE(objects.now(1).visible);
    EXPECT_EQ(objects.room()->roomIrradiance().irradiance, light->irradiance);
    objects.setLight(std::make_shared<IrradianceAtlas>(placed.room->field.atlas));
    EXPECT_TRUE(placed.update(0));
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

TEST(Objects, OneThatIsMadeToMirrorReflectsNoMoreThanItGets) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    ObjectSource source = objects.scenario().objects[0].source;
    source.diffuse = Vec3(0.8f, 0.3f, 0.3f);
    source.mirror = Vec3(0);
    objects.setSource(0, source);
    source.mirror = Vec3(0.6f);
    objects.setSource(0, source);
    expectNear(*objects.scenario().objects[0].source.mirror, Vec3(0.6f));
    expectNear(*objects.scenario().objects[0].source.diffuse, {0.4f, 0.3f, 0.3f});
    source = objects.scenario().objects[0].source;
    source.diffuse = Vec3(0.9f, 0.1f, 0.1f);
    objects.setSource(0, source);
    expectNear(*objects.scenario().objects[0].source.diffuse, {0.9f, 0.1f, 0.1f});
    expectNear(*objects.scenario().objects[0].source.mirror, {0.1f, 0.6f, 0.6f});
    expectNear(objects.now(0).model->scene().materials[0].mirror, {0.1f, 0.6f, 0.6f});
    EXPECT_NO_THROW(parseScenario(toText(objects.scenario(), "saved.json"), "saved.json"));
}

TEST(Objects, OneIsSpokenOfByTheNameItHasBeenGiven) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    objects.setName(0, "table");
    objects.toggleSubject();
    EXPECT_EQ(placed.said, "keys move table");
    objects.setName(0, "sphere");
    EXPECT_EQ(objects.name(0), "sphere 2") << "another has it";
    objects.setName(0, "sphere");
    EXPECT_EQ(objects.name(0), "sphere 2") << "while it is being typed";
    objects.setName(0, "");
    EXPECT_EQ(objects.name(0), "sphere 2");
    objects.setName(0, "table");
    objects.duplicate(0);
    EXPECT_EQ(objects.name(2), "table 2");
}

TEST(Objects, HiddenOnesAreNeitherSelectedByKeysNorMoved) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    objects.select(0);
    objects.toggleSubject();
    objects.setVisible(0, false);
    EXPECT_EQ(objects.subject(), Subject::camera);
    objects.toggleSubject();
    EXPECT_EQ(objects.subject(), Subject::camera);
    EXPECT_EQ(placed.said, "cube is hidden: show it in the panel");
    for (int i = 0; i < 2; ++i) {
        objects.selectNext();
        EXPECT_EQ(objects.selected(), 1u);
    }
    EXPECT_FALSE(objects.scenario().objects[0].object.visible);
    ASSERT_EQ(objects.visible().size(), 1u);
    EXPECT_EQ(objects.visible()[0].name, "sphere");
    objects.setVisible(1, false);
    objects.selectNext();
    EXPECT_EQ(placed.said, "all objects are hidden: show one in the panel");
}

TEST(Objects, OneThatMovesByItselfStaysHiddenAndGoesOn) {
    Scenario scenario{{bodyAt("cube", {1, 0.5f, 2})}};
    const Pose start = scenario.objects[0].object.pose;
    Pose end = start;
    end.translation.x += 1;
    scenario.objects[0].motion = KeyframeMotion{{{0, start}, {10, end}}};
    PlacedObjects placed{scenario};
    Objects& objects = *placed.objects;
    objects.setVisible(0, false);
    placed.update(5);
    EXPECT_FALSE(objects.now(0).visible);
    EXPECT_TRUE(objects.room()->litObjects().empty());
    expectNear(objects.now(0).pose.translation, {1.5f, 0.5f, 2});
    const Scenario saved = parseScenario(toText(objects.scenario(), "s.json"), "s.json");
    EXPECT_FALSE(objectsAt(saved, 5)[0].visible);
    objects.setVisible(0, true);
    placed.update(6);
    EXPECT_TRUE(objects.now(0).visible);
}

TEST(Objects, ACopyOfAMovingOneIsAsItIsNow) {
    Scenario scenario{{bodyAt("cube", {1, 0.5f, 2})}};
    scenario.objects[0].object.visible = false;
    scenario.objects[0].motion = appearing(scenario.objects[0].object.pose);
    PlacedObjects placed{scenario};
    placed.update(2);
    placed.objects->duplicate(0);
    placed.update(2);
    EXPECT_TRUE(placed.objects->now(1).visible);
    EXPECT_TRUE(placed.objects->scenario().objects[1].object.visible);
}

TEST(Objects, NoneIsMovedOutOfTheWorld) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    Pose pose = objects.now(0).pose;
    pose.translation = {3e7f, 0, -3e7f};
    objects.setPose(0, pose);
    EXPECT_EQ(objects.now(0).pose.translation, Vec3(1e5f, 0, -1e5f));
    EXPECT_NO_THROW(parseScenario(toText(objects.scenario(), "saved.json"), "saved.json"));
}

TEST(Objects, WhatWasRemovedSinceItWasShownIsNotPicked) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    const Ray toCube{Vec3(3.3f, 0.5f, 1), {1, 0, 0}}, toSphere{Vec3(5.3f, 0.5f, 1), {-1, 0, 0}};
    ASSERT_EQ(objects.pick(toSphere), 1u);
    objects.remove(0);
    EXPECT_FALSE(objects.pick(toCube));
    EXPECT_EQ(objects.pick(toSphere), 0u);
}

TEST(Objects, SettingsThatCannotBeLitAreTakenBackAndItIsSaidWhy) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    const ObjectSettings before = objects.now(0).settings;
    objects.setSettings(0, unlightable());
    EXPECT_TRUE(placed.update(1));
    EXPECT_EQ(objects.now(0).settings, before);
    EXPECT_EQ(objects.scenario().objects[0].object.settings, before);
    EXPECT_NE(placed.said.find("texels of 0.000001 m"), std::string::npos) << placed.said;
    EXPECT_FALSE(placed.update(2)) << "all is well";
    ObjectSettings others = before;
    others.directSamples = 4;
    objects.setSettings(0, others);
    EXPECT_TRUE(placed.update(3));
    EXPECT_EQ(objects.now(0).settings, others);
}

TEST(Objects, OneThatCannotBeLitIsNotAdded) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    ScenarioObject cube = bodyAt("cube", {1, 1, 1});
    cube.object.settings = unlightable();
    objects.select(1);
    objects.add(cube);
    EXPECT_FALSE(objects.shown(2));
    placed.update(1);
    ASSERT_EQ(objects.size(), 2u);
    EXPECT_FALSE(objects.selected());
    EXPECT_EQ(objects.room()->litObjects().size(), 2u);
}

TEST(Objects, OneThatCannotBeLitStaysHidden) {
    Scenario scenario{{bodyAt("cube", {1, 1, 1})}};
    scenario.objects[0].object.settings = unlightable();
    scenario.objects[0].object.visible = false;
    PlacedObjects placed{scenario};
    placed.objects->setVisible(0, true);
    placed.update(1);
    EXPECT_FALSE(placed.objects->now(0).visible);
    EXPECT_FALSE(placed.objects->scenario().objects[0].object.visible);
}

TEST(Objects, OneThatCannotBeLitIsFoundBeforeItAppears) {
    Scenario scenario{{bodyAt("cube", {1, 1, 1})}};
    scenario.objects[0].object.settings = unlightable();
    scenario.objects[0].motion = appearing(scenario.objects[0].object.pose);
    EXPECT_THROW(PlacedObjects{scenario}, InputError);
    scenario.objects[0].object.settings = bodyAt("cube", {1, 1, 1}).object.settings;
    PlacedObjects placed{scenario};
    EXPECT_FALSE(placed.objects->now(0).visible);
    EXPECT_TRUE(placed.objects->room()->litObjects().empty());
    EXPECT_EQ(placed.shows, 1);
    placed.update(2);
    EXPECT_EQ(placed.objects->room()->litObjects().size(), 1u);
}

TEST(Objects, WhatCannotBeShownIsTakenBack) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    const auto show = [&](const DynamicRoom& room) {
        if (room.object(0).settings.directSamples == 4) throw InputError("the GPU is full");
        ++placed.shows;
    };
    ObjectSettings settings = objects.now(0).settings;
    settings.directSamples = 4;
    objects.setSettings(0, settings);
    const int shows = placed.shows;
    EXPECT_TRUE(objects.update(1, placed.eye, show));
    EXPECT_EQ(placed.said, "the GPU is full");
    EXPECT_EQ(placed.shows, shows + 1) << "as it was before";
    EXPECT_NE(objects.now(0).settings.directSamples, 4);
}

TEST(Objects, AnErrorThatNoChangeHasCausedIsThrown) {
    PlacedObjects placed;
    placed.objects->select(0);
    placed.objects->steer(push({1, 0, 0}), 0.1f);
    const auto show = [](const DynamicRoom&) { throw InputError("the GPU is full"); };
    EXPECT_THROW(placed.objects->update(1, placed.eye, show), InputError);
}

}  // namespace
}  // namespace vlf::app
