#include "vlf/display/camera_path.h"

#include "vlf/base/error.h"
#include "vlf/math/random.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace vlf {
namespace {

CameraPose standing(const Vec3& eye, float yaw = 0) {
    CameraPose pose;
    pose.eye = eye;
    pose.yaw = yaw;
    return pose;
}

CameraPose randomPose(RandomStream& random) {
    const auto between = [&](float a, float b) { return a + (b - a) * random.next(); };
    return {{between(-5, 5), between(0, 3), between(-5, 5)},
            between(-9, 9),
            between(-CameraPose::kMostPitch, CameraPose::kMostPitch),
            between(20, 90)};
}

std::vector<CameraSample> randomSamples(RandomStream& random, int count) {
    std::vector<CameraSample> samples;
    double seconds = random.next();
    for (int i = 0; i < count; ++i, seconds += 0.001 + random.next())
        samples.push_back({seconds, randomPose(random)});
    return samples;
}

TEST(CameraPath, PassesThroughItsSamples) {
    RandomStream random(1, 0);
    const std::vector<CameraSample> samples = randomSamples(random, 50);
    const CameraPath path(samples);
    for (const CameraSample& sample : samples) {
        const CameraPose pose = path.at(sample.seconds);
        EXPECT_EQ(pose.eye, sample.pose.eye);
        EXPECT_EQ(pose.pitch, sample.pose.pitch);
        EXPECT_EQ(pose.verticalFov, sample.pose.verticalFov);
        EXPECT_NEAR(std::remainder(pose.yaw - sample.pose.yaw, 2 * kPi), 0, 1e-5f);
    }
    EXPECT_EQ(path.duration(), samples.back().seconds);
}

TEST(CameraPath, NeverLeavesTheBoxOfTwoSamples) {
    RandomStream random(2, 0);
    const std::vector<CameraSample> samples = randomSamples(random, 40);
    const CameraPath path(samples);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        for (int k = 0; k <= 20; ++k) {
            const CameraPose &a = samples[i].pose, &b = samples[i + 1].pose;
            const CameraPose pose =
                path.at(std::lerp(samples[i].seconds, samples[i + 1].seconds, k / 20.0));
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(pose.eye[axis], std::min(a.eye[axis], b.eye[axis]));
                EXPECT_LE(pose.eye[axis], std::max(a.eye[axis], b.eye[axis]));
            }
            EXPECT_LE(std::abs(pose.pitch), CameraPose::kMostPitch);
        }
}

TEST(CameraPath, HasNoCorners) {
    RandomStream random(3, 0);
    const std::vector<CameraSample> samples = randomSamples(random, 40);
    const CameraPath path(samples);
    constexpr double kStep = 1e-4;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        const double t = samples[i].seconds;
        const double left = samples[i].seconds - samples[i - 1].seconds;
        const double right = samples[i + 1].seconds - samples[i].seconds;
        if (std::min(left, right) < 100 * kStep) continue;
        const Vec3 before = path.at(t).eye - path.at(t - kStep).eye;
        const Vec3 after = path.at(t + kStep).eye - path.at(t).eye;
        const double speed = glm::distance(samples[i - 1].pose.eye, samples[i].pose.eye) / left +
                             glm::distance(samples[i].pose.eye, samples[i + 1].pose.eye) / right;
        const double acceleration = 8 * speed / std::min(left, right);  // at most
        EXPECT_LT(glm::distance(before, after), acceleration * kStep * kStep + 2e-6) << i;
    }
}

TEST(CameraPath, KeepsAnEvenPaceThroughEvenSamples) {
    std::vector<CameraSample> samples;
    for (int i = 0; i < 10; ++i) samples.push_back({0.1 * i, standing({0, 0, -0.2f * i})});
    const CameraPath path(samples);
    for (double t = 0.1; t < 0.8; t += 0.013) EXPECT_NEAR(path.at(t).eye.z, -2 * t, 1e-6);
}

TEST(CameraPath, TurnsTheShortWay) {
    const float nearBehind = kPi - 0.1f;
    const CameraPath path({{0, standing({}, nearBehind)}, {1, standing({}, -nearBehind)}});
    for (double t = 0; t <= 1; t += 0.05)
        EXPECT_LE(std::abs(std::remainder(path.at(t).yaw - kPi, 2 * kPi)), 0.1001f) << t;
}

TEST(CameraPath, StandsStillBeforeAndAfter) {
    const CameraPath path({{1, standing({1, 0, 0})}, {2, standing({2, 0, 0})}});
    EXPECT_EQ(path.at(0), path.samples().front().pose);
    EXPECT_EQ(path.at(-5), path.samples().front().pose);
    EXPECT_EQ(path.at(7), path.samples().back().pose);
    const CameraPath single({{0, standing({3, 0, 0})}});
    EXPECT_EQ(single.at(4).eye.x, 3);
}

TEST(CameraPath, RefusesWhatIsNoPath) {
    const auto refused = [](std::vector<CameraSample> samples, const char* says) {
        try {
            CameraPath path(std::move(samples), "walk.json");
            ADD_FAILURE() << "accepted: " << says;
        } catch (const InputError& e) {
            EXPECT_NE(std::string(e.what()).find("walk.json"), std::string::npos) << e.what();
            EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
        }
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    refused({}, "at least one");
    refused({{1, standing({})}, {1, standing({})}}, "camera[1]: times must increase");
    refused({{2, standing({})}, {1, standing({})}}, "camera[1]: times must increase");
    refused({{-1, standing({})}}, "camera[0]: the time");
    refused({{nan, standing({})}}, "camera[0]: the time");
    refused({{1e9, standing({})}}, "camera[0]: the time");
    refused({{0, standing({0, nan, 0})}}, "the eye");
    refused({{0, standing({0, 1e8f, 0})}}, "the eye");
    refused({{0, standing({}, nan)}}, "yaw");
    CameraPose pose;
    pose.pitch = 1.56f;
    refused({{0, pose}}, "pitch");
    pose = {}, pose.verticalFov = 180;
    refused({{0, pose}}, "field of view");
}

TEST(PathRecorder, LeavesOutNothingThatChangesThePath) {
    RandomStream random(4, 0);
    std::vector<CameraSample> all;
    PathRecorder recorder;
    CameraPose pose = randomPose(random);
    for (int i = 0; i < 500; ++i) {
        if (random.next() < 0.3f) pose = randomPose(random);
        all.push_back({0.016 * i, pose});
        recorder.record(all.back().seconds, pose);
    }
    const CameraPath complete(all), recorded = recorder.path();
    EXPECT_LT(recorded.samples().size(), all.size() - 100);
    EXPECT_EQ(recorded.duration(), complete.duration());
    for (double t = 0; t < complete.duration(); t += 0.0037) {
        EXPECT_NEAR(glm::distance(recorded.at(t).eye, complete.at(t).eye), 0, 1e-5f) << t;
        EXPECT_NEAR(recorded.at(t).yaw, complete.at(t).yaw, 1e-5f) << t;
    }
}

TEST(PathRecorder, ARestTakesTwoSamples) {
    PathRecorder recorder;
    EXPECT_TRUE(recorder.empty());
    EXPECT_THROW(recorder.path(), InputError);
    for (int i = 0; i <= 1000; ++i) recorder.record(0.01 * i, standing({1, 2, 3}));
    EXPECT_EQ(recorder.path().samples().size(), 2u);
    EXPECT_NEAR(recorder.path().duration(), 10, 1e-9);
}

TEST(PathRecorder, TheLaterOfTwoPosesAtATimeHolds) {
    PathRecorder recorder;
    recorder.record(0, standing({1, 0, 0}));
    recorder.record(0, standing({2, 0, 0}));
    EXPECT_EQ(recorder.path().at(0).eye.x, 2);
    recorder.record(1e-9, standing({3, 0, 0}));
    EXPECT_EQ(recorder.path().at(0).eye.x, 3);
}

TEST(PathRecorder, NothingIsSeenBetweenTheEndsOfAJump) {
    PathRecorder recorder;
    recorder.jump(0, standing({0, 0, 0}));
    recorder.record(0.5, standing({0, 0, 1}));
    recorder.jump(0.6, standing({5, 0, 0}));
    recorder.record(0.7, standing({5, 0, 1}));
    const CameraPath path = recorder.path();
    for (double t = 0; t < 0.7; t += 0.00099) EXPECT_EQ(path.at(t).eye.x, t < 0.6 ? 0 : 5) << t;
    EXPECT_EQ(path.at(0.6).eye, Vec3(5, 0, 0));
    EXPECT_EQ(path.at(0.59).eye, Vec3(0, 0, 1));
}

TEST(Tour, RestsAtEveryCameraAndStrollsBetween) {
    const std::vector<Camera> cameras{
        {"a", {0, 1, 0}, {0, 1, -1}}, {"b", {4, 1, 0}, {4, 1, -1}}, {"c", {4, 1, 0}, {4, 1, 1}}};
    const CameraPath path = tour(cameras);
    for (const Camera& camera : cameras) {
        double rest = 0, fastest = 0;
        for (double t = 0; t < path.duration(); t += 0.01) {
            const CameraPose pose = path.at(t), next = path.at(t + 0.01);
            const float away = glm::distance(pose.eye, camera.eye) +
                               glm::distance(pose.forward(), camera.look - camera.eye);
            if (away < 1e-4f) rest += 0.01;
            fastest = std::max(fastest, glm::distance(pose.eye, next.eye) / 0.01);
        }
        EXPECT_GT(rest, 0.97) << camera.name;
        EXPECT_LT(fastest, 1.3);
    }
    EXPECT_THROW(tour(std::span(cameras).first(1)), InputError);
}

}  // namespace
}  // namespace vlf
