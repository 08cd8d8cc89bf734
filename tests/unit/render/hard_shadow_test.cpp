// Shadows laid over the picture: where they fall and where not.

#include "object_room.h"
#include "vlf/render/cpu/hard_shadows.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

using namespace test;

constexpr float kOpacity = 0.6f;

/// A floor at y = 0, and a light at y = 2 above it that shines down.
class HardShadow : public testing::Test {
  protected:
    SceneBuilder builder;
    std::uint32_t white = builder.material("white", Vec3(0.5f));
    PointLight light{{0, 2, 0}, Vec3(10), {0, -1, 0}};

    HardShadow() { floorAt(0, 2); }

    /// A square that faces up.
    void floorAt(float height, float half) {
        builder.quad({-half, height, -half}, {0, 0, 2 * half}, {2 * half, 0, 0}, white);
    }

    /// What a cube of 0.2 m at a height leaves of the radiance at a place of a surface.
    float remaining(float cubeHeight, const Vec3& position, const Vec3& normal = {0, 1, 0}) {
        const RayScene rays(builder.scene());
        const ObjectModel model(makePrimitive("cube", plain(Vec3(0.5f))));
        LitObject cube;
        cube.mesh = &model.mesh();
        cube.pose.translation = {0, cubeHeight, 0};
        cube.pose.scale = 0.2f;
        Surface surface;
        surface.position = position;
        surface.normal = surface.geometricNormal = normal;
        return HardShadows(builder.scene(), rays, &light, {{&cube, kOpacity}}).remaining(surface);
    }
};

TEST_F(HardShadow, FallsBehindTheObjectOnly) {
    EXPECT_FLOAT_EQ(remaining(1, {0, 0, 0}), 1 - kOpacity);
    EXPECT_FLOAT_EQ(remaining(1, {0.15f, 0, 0}), 1 - kOpacity);
    EXPECT_FLOAT_EQ(remaining(1, {0.35f, 0, 0}), 1);
    EXPECT_FLOAT_EQ(remaining(2.5f, {0, 0, 0}), 1);  // above the light
}

TEST_F(HardShadow, LeavesFacesThatAreTurnedAway) {
    EXPECT_FLOAT_EQ(remaining(1, {0, 0.5f, 0}, {0, -1, 0}), 1);
    light.normal = {0, 1, 0};  // shines away from the floor
    EXPECT_FLOAT_EQ(remaining(1, {0, 0, 0}), 1);
}

TEST_F(HardShadow, DoesNotPierceTheFirstReceiver) {
    floorAt(0.5f, 0.5f);
    EXPECT_FLOAT_EQ(remaining(1, {0, 0.5f, 0}), 1 - kOpacity);
    EXPECT_FLOAT_EQ(remaining(1, {0, 0, 0}), 1);
}

TEST_F(HardShadow, IsNotCastWhereTheRoomShadesAlready) {
    floorAt(1.5f, 0.5f);
    EXPECT_FLOAT_EQ(remaining(1, {0, 0, 0}), 1);
}

TEST_F(HardShadow, IsNotStoppedByTheLamp) {
    const std::uint32_t lamp = builder.material("lamp", Vec3(0), Vec3(10));
    builder.quad({-0.1f, 1.9f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}, lamp);
    EXPECT_FLOAT_EQ(remaining(1, {0, 0, 0}), 1 - kOpacity);
}

TEST_F(HardShadow, NeedsALight) {
    const RayScene rays(builder.scene());
    Surface surface;
    surface.normal = surface.geometricNormal = {0, 1, 0};
    EXPECT_FLOAT_EQ(HardShadows(builder.scene(), rays, nullptr, {{}}).remaining(surface), 1);
}

}  // namespace
}  // namespace vlf
