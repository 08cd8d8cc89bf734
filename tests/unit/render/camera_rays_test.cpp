#include "vlf/render/cpu/camera_rays.h"

#include "vlf/base/error.h"

#include <limits>

#include <gtest/gtest.h>

namespace vlf {
namespace {

Camera lookingAlongMinusZ() {
    return {"test", {1, 2, 3}, {1, 2, -7}, {0, 1, 0}, 90};
}

void expectNear(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(glm::distance(a, b), 0, 1e-5) << a.x << " " << a.y << " " << a.z;
}

TEST(CameraRays, CentreOfThePictureLooksAtLook) {
    const CameraRays rays(lookingAlongMinusZ(), 40, 20);
    const Ray ray = rays.ray(20, 10);
    expectNear(ray.origin, {1, 2, 3});
    expectNear(ray.direction, {0, 0, -1});
}

TEST(CameraRays, FieldOfViewIsVerticalAndRowZeroIsOnTop) {
    const CameraRays rays(lookingAlongMinusZ(), 40, 20);
    expectNear(rays.ray(20, 0).direction, glm::normalize(Vec3(0, 1, -1)));
    expectNear(rays.ray(20, 20).direction, glm::normalize(Vec3(0, -1, -1)));
    expectNear(rays.ray(0, 10).direction, glm::normalize(Vec3(-2, 0, -1)));
    expectNear(rays.ray(40, 0).direction, glm::normalize(Vec3(2, 1, -1)));
}

TEST(CameraRays, DirectionsAreUnit) {
    const CameraRays rays(lookingAlongMinusZ(), 64, 64);
    EXPECT_NEAR(glm::length(rays.ray(3.2f, 60.1f).direction), 1, 1e-6);
}

TEST(CameraRays, UpNeedNotBePerpendicular) {
    Camera camera = lookingAlongMinusZ();
    camera.up = {0, 3, -5};
    expectNear(CameraRays(camera, 20, 20).ray(10, 0).direction, glm::normalize(Vec3(0, 1, -1)));
}

TEST(CameraRays, RefusesCamerasWithoutAView) {
    const Camera good = lookingAlongMinusZ();
    Camera c = good;
    c.look = c.eye;
    EXPECT_THROW(CameraRays(c, 8, 8), InputError);
    c = good, c.up = {0, 0, 2};
    EXPECT_THROW(CameraRays(c, 8, 8), InputError);
    c = good, c.up = Vec3(0);
    EXPECT_THROW(CameraRays(c, 8, 8), InputError);
    c = good, c.eye.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(CameraRays(c, 8, 8), InputError);
    for (const float fov : {0.0f, -5.0f, 180.0f, std::numeric_limits<float>::quiet_NaN()}) {
        c = good, c.verticalFov = fov;
        EXPECT_THROW(CameraRays(c, 8, 8), InputError) << fov;
    }
    EXPECT_THROW(CameraRays(good, 0, 8), InputError);
    EXPECT_THROW(CameraRays(good, 8, -1), InputError);
}

}  // namespace
}  // namespace vlf
