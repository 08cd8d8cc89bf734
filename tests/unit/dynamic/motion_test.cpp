#include "vlf/dynamic/motion.h"

#include "vlf/base/error.h"
#include "vlf/dynamic/motion_recorder.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace vlf {
namespace {

Quat aboutY(float degrees) {
    return glm::angleAxis(degrees * kPi / 180, Vec3(0, 1, 0));
}

void expectNear(const Vec3& a, const Vec3& b, float tolerance = 1e-5f) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

void expectSameRotation(const Quat& a, const Quat& b) {
    EXPECT_GT(std::abs(glm::dot(a, b)), 1 - 1e-5f);
}

KeyframeMotion fourKeyframes(Interpolation interpolation) {
    KeyframeMotion motion;
    motion.interpolation = interpolation;
    motion.keyframes = {{1, {{0, 0, 0}, aboutY(0), 1}},
                        {2, {{1, 0, 0}, aboutY(90), 2}},
                        {4, {{3, 1, 0}, aboutY(170), 4}},
                        {5, {{3, 5, 0}, aboutY(-170), 4}}};
    return motion;
}

TEST(Motion, KeyframesAreMetExactlyAndTheEndsAreHeld) {
    for (const Interpolation kind : {Interpolation::linear, Interpolation::smooth}) {
        const KeyframeMotion motion = fourKeyframes(kind);
        for (const Keyframe& keyframe : motion.keyframes)
            EXPECT_EQ(poseAt(motion, {}, keyframe.seconds), keyframe.pose);
        EXPECT_EQ(poseAt(motion, {}, 0), motion.keyframes.front().pose);
        EXPECT_EQ(poseAt(motion, {}, 1000), motion.keyframes.back().pose);
    }
}

TEST(Motion, LinearKeyframesGoStraightAndTurnTheShortWay) {
    const KeyframeMotion motion = fourKeyframes(Interpolation::linear);
    const Pose half = poseAt(motion, {}, 1.5);
    expectNear(half.translation, {0.5f, 0, 0});
    expectSameRotation(half.rotation, aboutY(45));
    EXPECT_NEAR(half.scale, 1.5f, 1e-5f);
    expectSameRotation(poseAt(motion, {}, 4.5).rotation, aboutY(180));
}

TEST(Motion, SmoothKeyframesHaveNoJumpOfSpeed) {
    const KeyframeMotion motion = fourKeyframes(Interpolation::smooth);
    constexpr double kStep = 1e-3;
    const auto speedAt = [&](double seconds) {
        return (poseAt(motion, {}, seconds + kStep).translation -
                poseAt(motion, {}, seconds).translation) /
               static_cast<float>(kStep);
    };
    for (const double seconds : {2.0, 4.0})
        expectNear(speedAt(seconds - kStep), speedAt(seconds), 0.03f);
    EXPECT_GT(glm::length(speedAt(2)), 0.5f);
}

TEST(Motion, SmoothScaleStaysAboveZero) {
    KeyframeMotion motion;
    motion.keyframes = {{0, {{}, aboutY(0), 100}},
                        {1, {{}, aboutY(0), 1e-3f}},
                        {2, {{}, aboutY(0), 1e-3f}},
                        {3, {{}, aboutY(0), 100}}};
    for (int i = 0; i <= 300; ++i) EXPECT_GT(poseAt(motion, {}, i / 100.0).scale, 0);
}

TEST(Motion, ALoopBeginsAgainWithoutAKink) {
    KeyframeMotion motion;
    motion.loop = true;
    motion.keyframes = {
        {0, {{1, 0, 0}}}, {1, {{0, 0, 1}}}, {2, {{-1, 0, 0}}}, {3, {{0, 0, -1}}}, {4, {{1, 0, 0}}}};
    for (const double seconds : {0.3, 1.7, 3.9})
        EXPECT_EQ(poseAt(motion, {}, seconds + 8), poseAt(motion, {}, seconds));
    constexpr double kStep = 1e-3;
    const Vec3 before = Vec3(1, 0, 0) - poseAt(motion, {}, 4 - kStep).translation;
    const Vec3 after = poseAt(motion, {}, kStep).translation - Vec3(1, 0, 0);
    expectNear(before, after, 1e-4f);
    EXPECT_GT(glm::length(after), 5e-4f);
}

TEST(Motion, VisibilityHoldsFromItsKeyframeOn) {
    KeyframeMotion motion = fourKeyframes(Interpolation::linear);
    motion.keyframes[0].visible = motion.keyframes[2].visible = false;
    for (const auto& [seconds, visible] :
         {std::pair{0.0, false}, {1.9, false}, {2.0, true}, {3.9, true}, {4.5, false}, {9.0, true}})
        EXPECT_EQ(visibleAt(motion, true, seconds), visible) << seconds;
    EXPECT_FALSE(visibleAt(TurnMotion{}, false, 1));
}

TEST(Motion, ATurnKeepsThePlace) {
    const Pose rest{{1, 2, 3}, aboutY(10), 0.5f};
    const Motion motion = TurnMotion{{0, 1, 0}, 90};
    EXPECT_EQ(poseAt(motion, rest, 0).translation, rest.translation);
    const Pose later = poseAt(motion, rest, 4e5 + 1);
    EXPECT_EQ(later.translation, rest.translation);
    EXPECT_EQ(later.scale, 0.5f);
    expectSameRotation(later.rotation, aboutY(100));
}

TEST(Motion, ACircleKeepsTheDistanceAndTheSide) {
    const Pose rest{{2, 1, 0}, aboutY(0), 1};
    CircleMotion circle{{1, 0, 0}, {0, 1, 0}, 90, true};
    Pose later = poseAt(circle, rest, 1);
    expectNear(later.translation, {1, 1, -1});
    expectSameRotation(later.rotation, aboutY(90));
    circle.turns = false;
    later = poseAt(circle, rest, 1);
    expectNear(later.translation, {1, 1, -1});
    expectSameRotation(later.rotation, aboutY(0));
}

TEST(Motion, WhatStaysStays) {
    const Pose rest{{1, 2, 3}, aboutY(10), 0.5f};
    EXPECT_EQ(poseAt({}, rest, 17), rest);
    EXPECT_FALSE(moves({}));
}

TEST(MotionRecorder, EveryRecordedPoseIsMetAndRestsAreShort) {
    MotionRecorder recorder;
    EXPECT_TRUE(recorder.empty());
    const auto poseOf = [](int frame) {
        const int step = std::clamp(frame, 20, 30);  // rests, goes, rests
        return Pose{{step, 0, 0}, aboutY(5.0f * step), 1};
    };
    for (int frame = 0; frame <= 50; ++frame)
        recorder.record(frame / 30.0, poseOf(frame), frame != 40);
    const KeyframeMotion& motion = recorder.motion();
    EXPECT_NO_THROW(requireValid(motion));
    EXPECT_LT(motion.keyframes.size(), 20u);
    for (int frame = 0; frame <= 50; ++frame) {
        EXPECT_EQ(poseAt(motion, {}, frame / 30.0), poseOf(frame)) << frame;
        EXPECT_EQ(visibleAt(motion, true, frame / 30.0), frame != 40) << frame;
    }
}

TEST(MotionRecorder, OfOneTimeTheLastCounts) {
    MotionRecorder recorder;
    recorder.record(1, {{1, 0, 0}}, true);
    recorder.record(1, {{2, 0, 0}}, true);
    EXPECT_EQ(recorder.motion().keyframes.size(), 1u);
    EXPECT_EQ(poseAt(recorder.motion(), {}, 1).translation.x, 2);
}

TEST(Motion, WhatCannotBeFollowedIsRefused) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    KeyframeMotion unsorted = fourKeyframes(Interpolation::linear);
    unsorted.keyframes[1].seconds = 1;
    KeyframeMotion noPose = fourKeyframes(Interpolation::linear);
    noPose.keyframes[1].pose.scale = kNone;
    for (const Motion& motion :
         {Motion(KeyframeMotion{}), Motion(unsorted), Motion(noPose), Motion(TurnMotion{{}, 1}),
          Motion(TurnMotion{{0, 1, 0}, kNone}), Motion(CircleMotion{{kNone, 0, 0}})})
        EXPECT_THROW(requireValid(motion), InputError);
    EXPECT_NO_THROW(requireValid(fourKeyframes(Interpolation::smooth)));
    EXPECT_NO_THROW(requireValid({}));
}

}  // namespace
}  // namespace vlf
