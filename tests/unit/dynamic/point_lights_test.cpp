#include "vlf/dynamic/point_lights.h"

#include "vlf/math/form_factor.h"
#include "vlf/scene/generate/primitives.h"

#include "support/analytic_scenes.h"
#include "unit/dynamic/lit_room.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

using test::LitRoom;

PointLighting lightsOf(const LitRoom& room, const Vec3& irradiance, int maxLights = 8) {
    IrradianceAtlas atlas = room.field.atlas;
    for (Vec3& e : atlas.irradiance) e = irradiance;
    return estimatePointLights(room.scene, room.rays, room.texels, atlas, maxLights);
}

Vec3 totalPower(const PointLighting& lighting) {
    Vec3 sum(0);
    for (const PointLight& light : lighting.lights)
        sum += (light.normal == Vec3(0) ? 4 * kPi : kPi) * light.intensity;
    return sum;
}

/// A small plate of two triangles.
ObjectMesh plate() {
    test::SceneBuilder builder;
    builder.quad({-0.01f, 0, -0.01f}, {0, 0, 0.02f}, {0.02f, 0, 0},
                 builder.material("plate", Vec3(1)));
    return ObjectMesh(builder.scene());
}

/// Of the plate's upper side at a place in the room.
Vec3 irradianceAt(const LitRoom& room, const PointLighting& lighting, const Vec3& place) {
    const ObjectMesh mesh = plate();
    std::vector<Vec3> irradiance(mesh.sidedVertexCount());
    shadeByLights(lighting, mesh, {place, Quat(1, 0, 0, 0), 1}, room.rays, irradiance);
    return irradiance[0];
}

/// 2 m wide, with square lamps of radiance (5, 4, 3) below the ceiling at these places.
Scene roomWithLamps(const std::vector<Vec2>& places, float width) {
    test::SceneBuilder builder;
    builder.box(Vec3(-1), Vec3(1), true, builder.material("wall", Vec3(0.5f)));
    const auto lamp = builder.material("lamp", Vec3(0), {5, 4, 3});
    for (const Vec2& p : places)
        builder.quad({p.x - width / 2, 0.99f, p.y - width / 2}, {width, 0, 0}, {0, 0, width}, lamp);
    return builder.scene();
}

TEST(PointLights, ASmallLampIsOneLightWithItsIrradiance) {
    const LitRoom room(roomWithLamps({{0.2f, 0.1f}}, 0.1f), Vec3(0));
    const PointLighting lighting = lightsOf(room, Vec3(0));
    ASSERT_EQ(lighting.lights.size(), 1u);
    EXPECT_LT(glm::distance(lighting.lights[0].position, Vec3(0.2f, 0.99f, 0.1f)), 0.01f);
    EXPECT_LT(glm::distance(lighting.lights[0].normal, Vec3(0, -1, 0)), 1e-5f);
    EXPECT_LT(glm::distance(totalPower(lighting), kPi * 0.01f * Vec3(5, 4, 3)), 1e-4f);
    const Vec3 p(-0.3f, -0.9f, 0.3f);
    const Vec3 a(0.15f, 0.99f, 0.05f), x(0.1f, 0, 0), z(0, 0, 0.1f);
    const float factor = triangleFormFactor(p, {0, 1, 0}, a, a + x, a + x + z) +
                         triangleFormFactor(p, {0, 1, 0}, a, a + x + z, a + z);
    const Vec3 e = irradianceAt(room, lighting, p);
    EXPECT_NEAR(e.x, kPi * 5 * factor, 0.02f * kPi * 5 * factor);
    EXPECT_NEAR(e.z, kPi * 3 * factor, 0.02f * kPi * 3 * factor);
}

TEST(PointLights, LightBehindAWallGivesNone) {
    Scene scene = roomWithLamps({{0, 0}}, 0.1f);
    test::SceneBuilder builder;
    builder.quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, builder.material("shelf", Vec3(0.5f)));
    append(scene, builder.scene());
    const LitRoom room(std::move(scene), Vec3(0));
    PointLighting lighting = lightsOf(room, Vec3(0));
    lighting.ambient = Vec3(0.25f);
    EXPECT_EQ(irradianceAt(room, lighting, {0, -0.5f, 0}), Vec3(0.25f));
    EXPECT_GT(irradianceAt(room, lighting, {0, 0.5f, 0}).x, 0.3f);
}

TEST(PointLights, ARoomWithoutEmittersHasItsMeanIrradianceForAmbient) {
    const LitRoom room(roomWithLamps({}, 0), Vec3(0));
    const PointLighting lighting = lightsOf(room, {1, 2, 3});
    EXPECT_TRUE(lighting.lights.empty());
    EXPECT_LT(glm::distance(lighting.ambient, Vec3(1, 2, 3)), 1e-4f);
    EXPECT_EQ(irradianceAt(room, lighting, Vec3(0)), lighting.ambient);
}

TEST(PointLights, AmbientIsTheIndirectLight) {
    // All of the lamp's power falls on the closed room's 24 m² and its own lit side.
    const LitRoom room(roomWithLamps({{0, 0}}, 0.5f), Vec3(0));
    const PointLighting lighting = lightsOf(room, Vec3(3));
    const float direct = kPi * 5 * 0.25f / 24.5f;
    EXPECT_NEAR(lighting.ambient.x, 3 - direct, 0.05f * direct);
}

TEST(PointLights, ManyLampsAreClusteredAndKeepTheirPower) {
    std::vector<Vec2> places;
    for (int i = 0; i < 25; ++i)
        places.push_back(
            {-0.8f + 0.4f * static_cast<float>(i % 5), -0.8f + 0.4f * static_cast<float>(i / 5)});
    const LitRoom room(roomWithLamps(places, 0.1f), Vec3(0));
    for (const int most : {1, 4, 8}) {
        const PointLighting lighting = lightsOf(room, Vec3(0), most);
        EXPECT_LE(lighting.lights.size(), static_cast<std::size_t>(most));
        EXPECT_NEAR(totalPower(lighting).x, 25 * kPi * 0.01f * 5, 1e-2f);
        for (std::size_t i = 1; i < lighting.lights.size(); ++i)
            EXPECT_GE(1.001f * luminance(lighting.lights[i - 1].intensity),
                      luminance(lighting.lights[i].intensity));
    }
}

TEST(PointLights, AWideLampIsSplit) {
    const LitRoom room(roomWithLamps({{0, 0}}, 1.8f), Vec3(0));
    EXPECT_EQ(lightsOf(room, Vec3(0), 1).lights.size(), 1u);
    const PointLighting lighting = lightsOf(room, Vec3(0));
    EXPECT_GE(lighting.lights.size(), 4u);
    const Vec3 p(0, -0.9f, 0);
    const Vec3 a(-0.9f, 0.99f, -0.9f), x(1.8f, 0, 0), z(0, 0, 1.8f);
    const float factor = triangleFormFactor(p, {0, 1, 0}, a, a + x, a + x + z) +
                         triangleFormFactor(p, {0, 1, 0}, a, a + x + z, a + z);
    EXPECT_NEAR(irradianceAt(room, lighting, p).x, kPi * 5 * factor, 0.05f * kPi * 5 * factor);
}

TEST(PointLights, ABulbShinesAllRound) {
    test::SceneBuilder builder;
    builder.box(Vec3(-1), Vec3(1), true, builder.material("wall", Vec3(0.5f)));
    builder.sphere({0.3f, 0.2f, 0}, 0.05f, 2, false, builder.material("bulb", Vec3(0), Vec3(100)));
    const LitRoom room(builder.scene(), Vec3(0));
    const PointLighting lighting = lightsOf(room, Vec3(0));
    ASSERT_EQ(lighting.lights.size(), 1u);
    EXPECT_EQ(lighting.lights[0].normal, Vec3(0));
    EXPECT_LT(glm::distance(lighting.lights[0].position, Vec3(0.3f, 0.2f, 0)), 0.01f);
    const float expected = 100 * kPi * 0.05f * 0.05f;  // / r²; the icosphere is a little smaller
    EXPECT_NEAR(irradianceAt(room, lighting, {0.3f, -0.8f, 0}).x, expected, 0.05f * expected);
}

TEST(PointLights, BackSidesOfAnOpenMeshAreLitFromTheirSide) {
    const LitRoom room(roomWithLamps({{0, 0}}, 0.1f), Vec3(0));
    const PointLighting lighting = lightsOf(room, Vec3(0));
    const ObjectMesh mesh = plate();
    std::vector<Vec3> irradiance(mesh.sidedVertexCount());
    const Quat upsideDown = glm::angleAxis(kPi, Vec3(1, 0, 0));
    shadeByLights(lighting, mesh, {Vec3(0), upsideDown, 1}, room.rays, irradiance);
    EXPECT_EQ(irradiance[0], lighting.ambient);
    EXPECT_GT(irradiance[mesh.scene.positions.size()].x, 0.01f);
}

}  // namespace
}  // namespace vlf
