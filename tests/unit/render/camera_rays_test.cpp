#include "vlf/render/cpu/camera_rays.h"

#include "vlf/base/error.h"
#include "vlf/render/cpu/projection.h"

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

TEST(CameraRays, AShiftMovesThePictureAndTurnsNothing) {
    Camera camera = lookingAlongMinusZ();
    camera.shift = {0.25f, -0.5f};
    const CameraRays rays(camera, 40, 20);
    expectNear(rays.ray(20, 10).direction, glm::normalize(Vec3(0.25f, -0.5f, -1)));
    expectNear(rays.ray(40, 0).direction, glm::normalize(Vec3(2.25f, 0.5f, -1)));
}

TEST(CameraRays, AShiftedPictureIsWhereItsProjectionPutsPoints) {
    Camera camera{"test", {1, 2, 3}, {-2, 1, -4}, {0.1f, 1, 0.2f}, 55};
    camera.shift = {0.1f, 0.2f};
    const CameraRays rays(camera, 320, 200);
    const Projection projection(camera, 320, 200);
    for (const Vec2& place : {Vec2(160, 100), Vec2(3, 190), Vec2(310, 7)}) {
        const Ray ray = rays.ray(place.x, place.y);
        const PicturePoint seen = *projection.project(ray.origin + 3.0f * ray.direction);
        EXPECT_NEAR(glm::distance(seen.position, place), 0, 1e-3f);
        expectNear(projection.unproject(place, seen.depth), ray.origin + 3.0f * ray.direction);
    }
}

TEST(CameraRays, SegmentsAreCutAtTheShiftedPicture) {
    Camera camera = lookingAlongMinusZ();
    camera.shift = {3, 0};  // all of it right of what an even picture of 90 degrees shows
    const Projection projection(camera, 20, 20);
    const auto seen = projection.project(Vec3(1 - 50, 2, -7), Vec3(1 + 100, 2, -7));
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->from.position.x, -4, 0.01f);
    EXPECT_NEAR(seen->to.position.x, 24, 0.01f);
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
    c = good, c.shift.y = std::numeric_limits<float>::infinity();
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
