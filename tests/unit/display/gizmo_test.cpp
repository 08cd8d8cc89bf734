#include "vlf/display/gizmo.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

Screen exampleScreen() {
    return {{"", {3, 2.5f, 4}, {0.2f, 0.1f, 0}, {0, 1, 0}, 45}, {800, 600}};
}

Pose examplePose() {
    return {{0.3f, 0.2f, -0.4f}, glm::angleAxis(0.4f, glm::normalize(Vec3(1, 2, 0.5f))), 0.5f};
}

Vec3 axisOf(const Pose& pose, int axis) {
    Vec3 unit(0);
    unit[axis] = 1;
    return pose.direction(unit);
}

TEST(Screen, ThePointOfARayLiesOnIt) {
    const Screen screen = exampleScreen();
    for (const Vec3& world : {Vec3(0, 0, 0), Vec3(1, 2, -3), Vec3(-40, 3, -80)}) {
        const Ray ray = screen.ray(*screen.point(world));
        const Vec3 way = world - ray.origin;
        EXPECT_LT(glm::length(glm::cross(way, ray.direction)), 1e-4f * glm::length(way));
        EXPECT_GT(glm::dot(way, ray.direction), 0);
    }
    const Vec3 behind = screen.eye() + Vec3(3, 2.5f, 4);
    EXPECT_FALSE(screen.point(behind));
    EXPECT_EQ(screen.pixelsPerMetre(behind), 0);
}

TEST(Screen, TheMiddleIsWhereTheCameraLooks) {
    const Screen screen = exampleScreen();
    const Vec2 middle = *screen.point({0.2f, 0.1f, 0});
    EXPECT_NEAR(middle.x, 400, 0.01f);
    EXPECT_NEAR(middle.y, 300, 0.01f);
    EXPECT_LT(screen.point({0.2f, 0.5f, 0})->y, 300) << "up is less";
    EXPECT_GT(screen.pixelsPerMetre({2, 1.5f, 3}), 2 * screen.pixelsPerMetre({0, 0, 0}));
}

TEST(Gizmo, EveryPartIsPickedWhereItIsDrawn) {
    const Screen screen = exampleScreen();
    const Gizmo gizmo(screen, examplePose());
    ASSERT_TRUE(gizmo.shown());
    for (int axis = 0; axis < 3; ++axis) {
        const GizmoHandle arm{GizmoPart::arm, axis};
        EXPECT_EQ(gizmo.pick(*screen.point(gizmo.armEnd(axis))), arm);
        Vec3 middle(0);
        for (const Vec3& corner : gizmo.plane(axis)) middle += 0.25f * corner;
        const GizmoHandle plane{GizmoPart::plane, axis};
        EXPECT_EQ(gizmo.pick(*screen.point(middle)), plane);
        int found = 0;
        for (int i = 0; i < Gizmo::kRingPoints; ++i)
            found += gizmo.pick(*screen.point(gizmo.ringPoint(axis, i))) ==
                     GizmoHandle{GizmoPart::ring, axis};
        EXPECT_GT(found, Gizmo::kRingPoints / 2) << "some are beneath arms or other rings";
    }
    EXPECT_FALSE(gizmo.pick(*screen.point(gizmo.centre()) + Vec2(200, 0)));
}

TEST(Gizmo, IsAsLargeFarAwayAsNear) {
    for (const float away : {1.0f, 50.0f}) {
        const Screen screen({"", {0, 0, away}, {0, 0, 0}, {0, 1, 0}, 60}, {640, 480});
        const Gizmo gizmo(screen, {});
        EXPECT_NEAR(screen.point(gizmo.armEnd(0))->x - 320, Gizmo::kArm, 0.1f);
    }
}

TEST(Gizmo, AnArmMovesTheObjectAlongItself) {
    const Screen screen = exampleScreen();
    const Pose pose = examplePose();
    const Gizmo gizmo(screen, pose);
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 along = axisOf(pose, axis);
        const Vec2 from = *screen.point(pose.translation + 0.1f * along);
        const Vec2 to = *screen.point(pose.translation + 0.35f * along);
        const Pose moved = gizmo.dragged({GizmoPart::arm, axis}, from, to);
        EXPECT_LT(glm::length(moved.translation - pose.translation - 0.25f * along), 1e-3f);
        EXPECT_EQ(moved.rotation, pose.rotation);
        // Across the arm there is no way to go.
        const Pose kept = gizmo.dragged({GizmoPart::arm, axis}, from, from);
        EXPECT_EQ(kept, pose);
    }
}

TEST(Gizmo, APlaneMovesTheObjectUnderThePointer) {
    const Screen screen = exampleScreen();
    const Pose pose = examplePose();
    const Gizmo gizmo(screen, pose);
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 by = 0.2f * axisOf(pose, (axis + 1) % 3) - 0.1f * axisOf(pose, (axis + 2) % 3);
        const Pose moved = gizmo.dragged({GizmoPart::plane, axis}, *screen.point(pose.translation),
                                         *screen.point(pose.translation + by));
        EXPECT_LT(glm::length(moved.translation - pose.translation - by), 1e-3f);
    }
}

TEST(Gizmo, ARingTurnsTheObjectAboutItsAxis) {
    const Screen screen = exampleScreen();
    const Pose pose = examplePose();
    const Gizmo gizmo(screen, pose);
    for (int axis = 0; axis < 3; ++axis) {
        const Pose turned =
            gizmo.dragged({GizmoPart::ring, axis}, *screen.point(gizmo.ringPoint(axis, 0)),
                          *screen.point(gizmo.ringPoint(axis, 6)));
        EXPECT_EQ(turned.translation, pose.translation);
        EXPECT_LT(glm::length(axisOf(turned, axis) - axisOf(pose, axis)), 1e-3f);
        const float cosine = glm::dot(axisOf(turned, (axis + 1) % 3), axisOf(pose, (axis + 1) % 3));
        EXPECT_NEAR(cosine, std::cos(2 * kPi * 6 / Gizmo::kRingPoints), 2e-3f);
        EXPECT_GT(glm::dot(axisOf(turned, (axis + 1) % 3), axisOf(pose, (axis + 2) % 3)), 0);
    }
}

TEST(Gizmo, WhatADragWouldNotMoveIsNotPicked) {
    const Screen screen({"", {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 60}, {640, 480});
    const Gizmo gizmo(screen, {});
    // The ring about X is a line behind the arm along Y.
    const Vec2 end = *screen.point(gizmo.armEnd(1));
    EXPECT_EQ(gizmo.pick(end), (GizmoHandle{GizmoPart::arm, 1}));
    EXPECT_EQ(gizmo.pick(*screen.point(-gizmo.armEnd(1))), GizmoHandle());
    EXPECT_EQ(gizmo.pick({320, 240}), GizmoHandle()) << "the arm along Z points at the eye";
}

TEST(Gizmo, WhereADragSaysNothingTheObjectStays) {
    const Screen screen({"", {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 60}, {640, 480});
    const Gizmo gizmo(screen, {});
    EXPECT_EQ(gizmo.dragged({GizmoPart::arm, 2}, {320, 240}, {400, 240}), Pose());
    EXPECT_EQ(gizmo.dragged({GizmoPart::plane, 0}, {320, 240}, {400, 240}), Pose());
    const Gizmo behind(screen, {{0, 0, 9}, {1, 0, 0, 0}, 1});
    EXPECT_FALSE(behind.shown());
    EXPECT_FALSE(behind.pick({320, 240}));
}

}  // namespace
}  // namespace vlf
