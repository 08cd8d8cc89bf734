#include "vlf/render/gl/view.h"

#include "vlf/render/cpu/projection.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

const Camera kCamera{"test", {1, 2, 3}, {-2, 1, -4}, {0.1f, 1, 0.2f}, 55};

Vec2 pixelOf(const View& view, const Vec3& p) {
    const Vec4 clip = view.clipFromWorld * Vec4(p, 1);
    return {0.5f * (clip.x / clip.w + 1) * view.width, 0.5f * (1 - clip.y / clip.w) * view.height};
}

}  // namespace

TEST(View, PutsPointsWhereTheCpuDoes) {
    const View view = viewOf(kCamera, 320, 200, 0.01f);
    const Projection projection(kCamera, 320, 200);
    for (const Vec3& p : {Vec3(-2, 1, -4), Vec3(0, 0, 0), Vec3(-5, 3, -1)}) {
        const Vec2 pixel = pixelOf(view, p), expected = projection.project(p)->position;
        EXPECT_NEAR(pixel.x, expected.x, 1e-3f);
        EXPECT_NEAR(pixel.y, expected.y, 1e-3f);
    }
}

TEST(View, ShiftsThePictureAsTheCpuDoes) {
    Camera camera = kCamera;
    camera.shift = {0.2f, -0.15f};
    const View view = viewOf(camera, 320, 200, 0.01f);
    const Projection projection(camera, 320, 200);
    for (const Vec3& p : {Vec3(-2, 1, -4), Vec3(0, 0, 0), Vec3(-5, 3, -1)}) {
        const Vec2 pixel = pixelOf(view, p), expected = projection.project(p)->position;
        EXPECT_NEAR(pixel.x, expected.x, 1e-3f);
        EXPECT_NEAR(pixel.y, expected.y, 1e-3f);
    }
}

TEST(View, AnOffsetSamplesElsewhereInThePixel) {
    const Vec3 p(-1, 1, -2);
    const Vec2 moved = pixelOf(shifted(viewOf(kCamera, 320, 200, 0.01f), {0.25f, -0.5f}), p) -
                       pixelOf(viewOf(kCamera, 320, 200, 0.01f), p);
    EXPECT_NEAR(moved.x, -0.25f, 1e-3f);
    EXPECT_NEAR(moved.y, 0.5f, 1e-3f);
}

TEST(View, CutsAtTheNearPlaneAndNotInTheDistance) {
    const View view = viewOf(kCamera, 320, 200, 0.01f);
    const Vec3 forward = glm::normalize(kCamera.look - kCamera.eye);
    const auto depth = [&](float metres) {
        const Vec4 clip = view.clipFromWorld * Vec4(kCamera.eye + metres * forward, 1);
        return clip.z / clip.w;
    };
    EXPECT_NEAR(depth(0.01f), -1, 1e-3f);
    EXPECT_LT(depth(1e5f), 1.0001f);
    EXPECT_GT(depth(2), depth(1));
}

}  // namespace vlf::test
