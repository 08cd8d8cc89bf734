#include "vlf/scene/scene.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

Scene cubeAt(const Vec3& corner, float size) {
    Scene scene;
    for (int i = 0; i < 8; ++i)
        scene.positions.push_back(corner + size * Vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
    return scene;
}

TEST(DefaultCamera, StandsInARoomAndLooksThroughIt) {
    for (const float size : {1e-3f, 4.0f, 1e5f}) {
        const Camera camera = defaultCamera(cubeAt(Vec3(-1), size));
        EXPECT_TRUE(glm::all(glm::greaterThan(camera.eye, Vec3(-1)))) << size;
        EXPECT_TRUE(glm::all(glm::lessThan(camera.eye, Vec3(-1 + size)))) << size;
        EXPECT_GT(glm::distance(camera.eye, camera.look), 0.3f * size);
    }
}

TEST(DefaultCamera, HasAViewOfASmallSceneFarFromTheOrigin) {
    for (const float offset : {1e5f, 1e7f, 3e9f}) {
        const Camera camera = defaultCamera(cubeAt(Vec3(offset), 1));
        EXPECT_NE(camera.eye, camera.look) << offset;
    }
}

}  // namespace
}  // namespace vlf
