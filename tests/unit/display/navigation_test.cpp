#include "vlf/display/navigation.h"

#include "support/analytic_scenes.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr float kEye = 1.65f, kRadius = 0.25f;

/// A room of 8 x 3 x 8 m, x and z in [-4, 4], the floor at y = 0.
struct Room {
    test::SceneBuilder builder;
    std::uint32_t wall = builder.material("wall", Vec3(0.5f));

    Room() { builder.box({-4, 0, -4}, {4, 3, 4}, true, wall); }
    void block(const Vec3& lower, const Vec3& upper) { builder.box(lower, upper, false, wall); }
};

/// On foot in a room, at first at the middle of it, looking along -Z.
struct Walk {
    Scene scene;
    RayScene rays{scene};
    Navigator navigator;

    explicit Walk(Room& room, const Vec3& eye = {0, kEye, 0})
        : scene(room.builder.scene()), navigator(scene, rays, poseAt(eye)) {
        navigator.setMovement(Movement::walk);
    }
    static CameraPose poseAt(const Vec3& eye) {
        CameraPose pose;
        pose.eye = eye;
        return pose;
    }
    Vec3 go(const Vec3& way, float seconds, float rate = 60) {
        Steering steering;
        steering.go = way;
        for (int i = 0; i < static_cast<int>(seconds * rate + 0.5f); ++i)
            navigator.advance(steering, 1 / rate);
        return eye();
    }
    Vec3 eye() const { return navigator.pose().eye; }
};

const Vec3 kForward(0, 0, 1), kRight(1, 0, 0);

TEST(Walking, IsLevelWhereverOneLooks) {
    Room room;
    Walk walk(room);
    CameraPose pose = walk.navigator.pose();
    pose.pitch = 1;
    walk.navigator.setPose(pose);
    const Vec3 eye = walk.go(kForward, 1);
    EXPECT_NEAR(eye.y, kEye, 1e-4);
    EXPECT_NEAR(eye.z, -1.4f, 0.15f) << "as fast as a person";
}

TEST(Walking, StopsAtWalls) {
    Room room;
    for (const Vec3& way : {kForward, -kForward, kRight, -kRight}) {
        Walk walk(room);
        const Vec3 eye = walk.go(way, 10);
        EXPECT_NEAR(std::max(std::abs(eye.x), std::abs(eye.z)), 4 - kRadius, 0.01f);
    }
}

TEST(Walking, StopsAtWallsAtAnySpeedAndFrameRate) {
    Room room;
    Walk walk(room);
    walk.navigator.setSpeedFactor(Navigator::kMostSpeed);
    Steering steering;
    steering.go = kForward + kRight;
    steering.fast = true;
    for (int i = 0; i < 20; ++i) walk.navigator.advance(steering, 0.5f);
    EXPECT_NEAR(walk.eye().x, 4 - kRadius, 0.01f);
    EXPECT_NEAR(walk.eye().z, -4 + kRadius, 0.01f);
    EXPECT_NEAR(walk.eye().y, kEye, 1e-3f);
}

TEST(Walking, SlidesAlongWalls) {
    Room room;
    Walk walk(room, {-3, kEye, -3.7f});
    const Vec3 eye = walk.go(kForward + kRight, 2);
    EXPECT_NEAR(eye.z, -4 + kRadius, 0.01f);
    EXPECT_NEAR(eye.x, -3 + 2 * 1.4f / std::sqrt(2.0f), 0.15f) << "unslowed but for the angle";
}

TEST(Walking, SlidesAlongWallsAtAnyAngle) {
    Room room;
    const float c = std::cos(0.35f), s = std::sin(0.35f);
    // A wall through (0, y, -2), not along a direction that is felt.
    room.builder.quad({-3 * c, 0, -2 - 3 * s}, {6 * c, 0, 6 * s}, {0, 3, 0}, room.wall);
    Walk walk(room, {0.5f, kEye, -1});
    const Vec3 eye = walk.go(kForward, 4);
    const float distance = glm::dot(eye - Vec3(0, kEye, -2), Vec3(-s, 0, c));
    EXPECT_NEAR(distance, kRadius, 0.02f);
    EXPECT_LT(eye.x, 0);
}

TEST(Walking, ClimbsALowStepAndComesDownAgain) {
    Room room;
    room.block({-4, 0, -2}, {4, 0.2f, -1});
    Walk walk(room);
    EXPECT_NEAR(walk.go(kForward, 1.1f).y, kEye + 0.2f, 1e-3f) << walk.eye().z;
    EXPECT_NEAR(walk.go(kForward, 1).y, kEye, 1e-3f);
    EXPECT_LT(walk.eye().z, -2);
}

TEST(Walking, ClimbsStairs) {
    Room room;
    for (int i = 0; i < 6; ++i)
        room.block({-1, 0, -1 - 0.3f * static_cast<float>(i + 1)},
                   {1, 0.18f * static_cast<float>(i + 1), -1 - 0.3f * static_cast<float>(i)});
    room.block({-1, 0, -4}, {1, 1.08f, -2.8f});
    Walk walk(room);
    EXPECT_NEAR(walk.go(kForward, 3).y, kEye + 1.08f, 1e-3f) << walk.eye().z;
}

TEST(Walking, ClimbsARamp) {
    Room room;
    room.builder.quad({-2, 0, -1}, {4, 0, 0}, {0, 1, -2}, room.wall);
    Walk walk(room);
    const Vec3 eye = walk.go(kForward, 1.5f);
    EXPECT_NEAR(eye.y, kEye + 0.5f * (-1 - eye.z), 0.05f);
    EXPECT_GT(eye.y, kEye + 0.3f);
}

TEST(Walking, DoesNotClimbAHighStep) {
    Room room;
    room.block({-4, 0, -2}, {4, 0.5f, -1});
    Walk walk(room);
    const Vec3 eye = walk.go(kForward, 3);
    EXPECT_NEAR(eye.z, -1 + kRadius, 0.01f);
    EXPECT_NEAR(eye.y, kEye, 1e-3f);
}

TEST(Walking, StopsAtTheBoardOfATable) {
    Room room;
    room.block({-1, 0.71f, -2}, {1, 0.73f, -1});
    Walk walk(room);
    EXPECT_NEAR(walk.go(kForward, 3).z, -1 + kRadius, 0.02f);
}

TEST(Walking, FallsToTheFloorAndNoFurther) {
    Room room;
    room.block({-1, 0, -1}, {1, 1, 1});
    Walk walk(room, {0, 1 + kEye, 0});
    EXPECT_NEAR(walk.eye().y, 1 + kEye, 1e-4f);
    const float least = [&] {
        float y = 10;
        for (int i = 0; i < 120; ++i) y = std::min(y, walk.go(kForward, 1 / 60.0f).y);
        return y;
    }();
    EXPECT_NEAR(walk.eye().y, kEye, 1e-4f);
    EXPECT_GT(least, kEye - 1e-3f);
    EXPECT_LT(walk.eye().z, -1);
}

TEST(Walking, BeginsOnTheFloorFromWhereverOneFlew) {
    Room room;
    Walk low(room, {0, 0.3f, 0});
    EXPECT_NEAR(low.eye().y, kEye, 1e-4f);
    Walk high(room, {0, 2.8f, 0});
    EXPECT_NEAR(high.go(Vec3(0), 2).y, kEye, 1e-4f);
}

TEST(Walking, StaysUpWhereThereIsNoFloor) {
    Room room;
    Walk walk(room, {0, 1, 20});
    EXPECT_NEAR(walk.go(kRight, 2).y, 1, 1e-4f);
}

TEST(Walking, StoopsUnderALowCeiling) {
    Room room;
    room.block({-4, 1.5f, -4}, {4, 3, 4});
    Walk walk(room, {0, 1, 0});
    EXPECT_LT(walk.eye().y, 1.5f);
    EXPECT_GT(walk.eye().y, 1.3f);
}

TEST(Walking, HardlyDependsOnTheFrameRate) {
    Room room;
    room.block({-4, 0, -3}, {0, 0.2f, -1});
    room.block({1, 0, -4}, {1.5f, 3, -1});
    const auto end = [&](float rate) {
        Walk walk(room);
        walk.go(kForward, 0.5f, rate);
        walk.go(kForward + kRight, 1.5f, rate);
        walk.go(-kRight, 1, rate);
        return walk.eye();
    };
    const Vec3 reference = end(480);
    for (const float rate : {20, 30, 60, 144})
        EXPECT_LT(glm::distance(end(rate), reference), 0.02f) << rate;
}

TEST(Walking, ABodyFitsALowRoom) {
    EXPECT_EQ(bodyFor({Vec3(0), Vec3(5)}).eyeHeight, Body{}.eyeHeight);
    EXPECT_NEAR(bodyFor({Vec3(0), Vec3(0.6f)}).eyeHeight, 0.41f, 0.01f);
}

TEST(Flying, GoesWhereOneLooksThroughAnything) {
    Room room;
    Walk flight(room);
    flight.navigator.setMovement(Movement::fly);
    CameraPose pose = flight.navigator.pose();
    pose.pitch = -CameraPose::kMostPitch;
    flight.navigator.setPose(pose);
    EXPECT_LT(flight.go(kForward, 3).y, -3);
}

TEST(Flying, DoesNotDependOnTheFrameRate) {
    Room room;
    const auto end = [&](float rate) {
        Walk flight(room);
        flight.navigator.setMovement(Movement::fly);
        flight.go(kForward, 1, rate);
        flight.go(kRight + Vec3(0, 1, 0), 1, rate);
        return flight.go(Vec3(0), 1, rate);
    };
    for (const float rate : {20, 144}) EXPECT_LT(glm::distance(end(rate), end(60)), 1e-3f);
}

TEST(Flying, ComesToRest) {
    Room room;
    Walk flight(room);
    flight.navigator.setMovement(Movement::fly);
    flight.go(kForward, 1);
    flight.go(Vec3(0), 1);
    const Vec3 rest = flight.eye();
    EXPECT_EQ(flight.go(Vec3(0), 1), rest);
}

TEST(Flying, SpeedIsTimesTheFactorAndThreefoldInAHurry) {
    Room room;
    const auto way = [&](float factor, bool fast) {
        Walk flight(room);
        flight.navigator.setMovement(Movement::fly);
        flight.navigator.setSpeedFactor(factor);
        Steering steering;
        steering.go = kForward;
        steering.fast = fast;
        flight.navigator.advance(steering, 1);
        return -flight.eye().z;
    };
    EXPECT_NEAR(way(2, false), 2 * way(1, false), 1e-3f);
    EXPECT_NEAR(way(1, true), 3 * way(1, false), 1e-3f);
}

TEST(Turning, KeepsThePitchShortOfTheZenith) {
    Room room;
    Walk walk(room);
    Steering steering;
    steering.turn = {0.5f, 9};
    walk.navigator.advance(steering, 0.01f);
    EXPECT_EQ(walk.navigator.pose().pitch, CameraPose::kMostPitch);
    EXPECT_NEAR(walk.navigator.pose().yaw, 0.5f, 1e-6f);
}

TEST(Gamepads, RestNearTheMiddleAndGoWhereTheStickPoints) {
    Gamepad pad;
    pad.leftStick = {0.1f, -0.1f};
    pad.rightStick = {0.05f, 0};
    EXPECT_EQ(steeringOf(pad, 1).go, Vec3(0));
    EXPECT_EQ(steeringOf(pad, 1).turn, Vec2(0));
    pad.leftStick = {0, -1};
    pad.rightStick = {1, 0};
    pad.rightTrigger = 1;
    const Steering steering = steeringOf(pad, 0.5f);
    EXPECT_NEAR(glm::distance(steering.go, Vec3(0, 1, 1)), 0, 1e-5f);
    EXPECT_LT(steering.turn.x, -0.5f) << "to the right";
    EXPECT_FALSE(steering.fast);
}

}  // namespace
}  // namespace vlf
