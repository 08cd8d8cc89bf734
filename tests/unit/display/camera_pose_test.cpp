#include "vlf/display/camera_pose.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

Camera looking(const Vec3& forward) {
    return {"c", Vec3(1, 2, 3), Vec3(1, 2, 3) + forward, {0, 1, 0}, 40};
}

TEST(CameraPose, KeepsWhereACameraStandsAndLooks) {
    for (const Vec3& forward : {Vec3(1, 0, 0), Vec3(-0.3f, 0.4f, 2), Vec3(0, -1, -0.5f)}) {
        const Camera camera = cameraOf(poseOf(looking(forward)));
        EXPECT_EQ(camera.eye, Vec3(1, 2, 3));
        EXPECT_EQ(camera.verticalFov, 40);
        EXPECT_NEAR(glm::distance(camera.look - camera.eye, glm::normalize(forward)), 0, 1e-6f);
    }
}

TEST(CameraPose, NeverLooksStraightUpOrDown) {
    EXPECT_EQ(poseOf(looking({0, 1, 0})).pitch, CameraPose::kMostPitch);
    EXPECT_EQ(poseOf(looking({0, -1, 0})).pitch, -CameraPose::kMostPitch);
}

TEST(CameraPose, RightIsLevelAndAcrossTheView) {
    const CameraPose pose = poseOf(looking({-0.3f, 0.4f, 2}));
    EXPECT_NEAR(glm::dot(pose.right(), pose.forward()), 0, 1e-6f);
    EXPECT_EQ(pose.right().y, 0);
    EXPECT_GT(glm::cross(pose.right(), pose.forward()).y, 0);
}

}  // namespace
}  // namespace vlf
