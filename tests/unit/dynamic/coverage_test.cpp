#include "lit_room.h"
#include "support/analytic_scenes.h"
#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/object_model.h"
#include "vlf/scene/generate/primitives.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

class Covered : public testing::Test {
  protected:
    /// 2 x 2 x 2 m, its floor at y = 0.
    static const LitRoom& room() {
        static const LitRoom lit(
            [] {
                SceneBuilder b;
                b.box({-1, 0, -1}, {1, 2, 1}, true, b.material("wall", Vec3(0.5f)));
                return b.scene();
            }(),
            Vec3(1));
        return lit;
    }

    Coverage coverage{room().texels};

    void cover(const Scene& body, const Pose& pose) {
        const ObjectModel model(body);
        LitObject lit;
        lit.mesh = &model.mesh();
        lit.pose = pose;
        const RayInstance instance{&lit.mesh->rays, pose};
        RayInstances instances;
        instances.place({&instance, 1});
        const Sphere sphere{pose.point(model.bounds().centre), pose.scale * model.bounds().radius};
        coverage.find(room().scene, room().rays, room().texels, instances, {&lit, 1}, {&sphere, 1});
    }

    void cover(const std::string& primitive, const Pose& pose) {
        cover(makePrimitive(primitive, {}), pose);
    }

    /// Of all of the room, m².
    float area() const {
        float sum = 0;
        for (const std::uint32_t t : room().texels.unwrap.texels)
            sum += room().texels.area[t] * (1 - coverage.uncovered(t));
        return sum;
    }

    std::size_t entries() const { return coverage.entries().size(); }
};

Pose standing(float size, float turn = 0) {
    return {{0.13f, 0.5f * size, -0.2f}, glm::angleAxis(turn, Vec3(0, 1, 0)), size};
}

TEST_F(Covered, ByACubeOnTheFloorIsItsFace) {
    for (const float turn : {0.0f, 0.4f}) {
        cover("cube", standing(0.5f, turn));
        EXPECT_NEAR(area() / 0.25f, 1, 0.02f) << turn;
    }
}

TEST_F(Covered, ByASphereHalfInTheFloorIsItsDisc) {
    cover("sphere", {{0.1f, 0, 0.2f}, Quat(1, 0, 0, 0), 0.8f});
    EXPECT_NEAR(area() / (kPi * 0.16f), 1, 0.02f);
}

TEST_F(Covered, InACornerIsOfAllThreeSides) {
    cover("cube", {{-1, 0, -1}, Quat(1, 0, 0, 0), 1});
    EXPECT_NEAR(area() / 0.75f, 1, 0.02f);
}

TEST_F(Covered, TexelsCutByAnEdgeInPart) {
    cover("cube", standing(0.5f, 0.4f));
    int whole = 0, part = 0;
    for (const std::uint32_t i : coverage.entries()) {
        const float uncovered = coverage.uncovered(room().texels.unwrap.texels[i]);
        const auto left = static_cast<float>(coverage.points(room().texels, i).size());
        const auto all = static_cast<float>(room().texels.unwrap.points.of(i).size());
        EXPECT_FLOAT_EQ(uncovered, left / all);
        EXPECT_LT(uncovered, 1);
        (uncovered > 0 ? part : whole) += 1;
    }
    EXPECT_GT(part, 5);
    EXPECT_GT(whole, 5);
}

TEST_F(Covered, IsNothingUnderWhatHangsInTheAir) {
    Pose pose = standing(0.5f);
    pose.translation.y += 0.01f;
    cover("cube", pose);
    EXPECT_EQ(entries(), 0u);
}

TEST_F(Covered, IsNothingByAnOpenMeshAboveOrThroughTheFloor) {
    SceneBuilder b;
    b.quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, b.material("sheet", Vec3(0.5f)));
    for (const float turn : {0.0f, kPi}) {
        cover(b.scene(), {{0, 0.1f, 0}, glm::angleAxis(turn, Vec3(1, 0, 0)), 1});
        EXPECT_EQ(entries(), 0u);
    }
    cover(b.scene(), {{0, 0, 0}, glm::angleAxis(0.5f * kPi, Vec3(1, 0, 0)), 1});
    EXPECT_EQ(entries(), 0u);
}

TEST_F(Covered, ByASheetThatLiesOnTheFloorIsItsArea) {
    SceneBuilder b;
    b.quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, b.material("sheet", Vec3(0.5f)));
    cover(b.scene(), {});
    EXPECT_NEAR(area(), 1, 0.02f);
}

TEST_F(Covered, IsForgottenWhereTheObjectHasLeft) {
    cover("cube", standing(0.5f));
    ASSERT_GT(entries(), 0u);
    coverage.find(room().scene, room().rays, room().texels, {}, {}, {});
    EXPECT_EQ(entries(), 0u);
    EXPECT_EQ(area(), 0);
}

TEST_F(Covered, TexelsShowTheLightBesideThem) {
    IrradianceAtlas light = room().field.atlas;
    for (Vec3& e : light.irradiance) e = Vec3(3);
    cover("cube", standing(0.5f));
    for (const std::uint32_t i : coverage.entries()) {
        const std::uint32_t t = room().texels.unwrap.texels[i];
        if (coverage.uncovered(t) <= 0) light.irradiance[t] = Vec3(0);
    }
    coverage.fill(room().texels, light);
    int filled = 0, left = 0;
    for (const std::uint32_t i : coverage.entries()) {
        const std::uint32_t t = room().texels.unwrap.texels[i];
        if (coverage.uncovered(t) > 0) continue;
        EXPECT_TRUE(light.irradiance[t] == Vec3(0) || light.irradiance[t] == Vec3(3));
        (light.irradiance[t] == Vec3(0) ? left : filled) += 1;
    }
    EXPECT_GT(filled, 0);
    EXPECT_GT(left, 0);  // the innermost
}

}  // namespace
}  // namespace vlf::test
