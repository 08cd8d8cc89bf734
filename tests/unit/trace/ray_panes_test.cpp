#include "support/analytic_scenes.h"
#include "vlf/trace/ray_scene.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr float kIor = 1.5f;
const Vec3 kTint(0.9f, 0.6f, 0.3f);

/// Panes at the given heights above a floor, each 2 m wide; the floor is triangles 0 and 1.
Scene panes(const std::vector<float>& heights) {
    test::SceneBuilder b;
    const std::uint32_t floor = b.material("floor", Vec3(0.5f)), glass = b.material("g", Vec3(0));
    b.scene().materials[glass].transmission = kTint;
    b.scene().materials[glass].ior = kIor;
    b.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, floor);
    for (const float y : heights) b.quad({-1, y, -1}, {0, 0, 2}, {2, 0, 0}, glass);
    return b.scene();
}

TEST(RayPanes, LetThroughWhatTheClosedFormSays) {
    const Scene scene = panes({1});
    const RayScene rays(scene);
    ASSERT_TRUE(rays.hasPanes());
    for (const Vec3& direction : {Vec3(0, -1, 0), glm::normalize(Vec3(0.5f, -1, 0.2f))}) {
        const float r = fresnelReflectance(-direction.y, kIor), share = 1 - 2 * r / (1 + r);
        const Transmittance t = rays.transmittance({Vec3(0.1f, 1.5f, 0.2f), direction, 0, 0.9f});
        EXPECT_NEAR(t.chance, share, 1e-5);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(t.colour[c], share * kTint[c], 1e-5);
    }
}

TEST(RayPanes, CountOnlyBetweenTheEndsOfTheRay) {
    const RayScene rays(panes({1, 2, 3}));
    const float share = 1 - paneReflectance(1, kIor);
    const auto passed = [&](float from, float to) {
        return rays.transmittance({Vec3(0, from, 0), Vec3(0, to - from, 0), 0, 1}).chance;
    };
    EXPECT_NEAR(passed(0.5f, 0.9f), 1, 1e-6);
    EXPECT_NEAR(passed(0.5f, 2.5f), share * share, 1e-5);
    EXPECT_NEAR(passed(3.5f, 0.5f), share * share * share, 1e-5);
}

TEST(RayPanes, AreStoppedByAnythingElse) {
    const RayScene rays(panes({1}));
    const Ray through{Vec3(0, 1.5f, 0), Vec3(0, -1, 0)};
    EXPECT_EQ(rays.transmittance(through).colour, Vec3(0));
    EXPECT_TRUE(rays.occluded(through));
    std::vector<Vec3> colours(2);
    const std::vector<Ray> both{through, {through.origin, through.direction, 0, 1}};
    rays.transmittance(both, colours);
    EXPECT_EQ(colours[0], Vec3(0));
    EXPECT_GT(colours[1].x, 0.8f);
}

TEST(RayPanes, ShowWhatIsBehindThem) {
    const Scene scene = panes({1, 1.0005f});
    const RayScene rays(scene);
    Transmittance passed;
    const Hit hit = rays.closestBehindPanes({Vec3(0.3f, 2, 0.1f), Vec3(0, -1, 0)}, passed);
    ASSERT_TRUE(hit);
    EXPECT_LT(hit.triangle, 2u);
    EXPECT_NEAR(hit.t, 2, 1e-5);
    EXPECT_NEAR(passed.chance, std::pow(1 - paneReflectance(1, kIor), 2), 1e-5);
    EXPECT_FALSE(rays.closestBehindPanes({Vec3(0, 2, 0), Vec3(0, -1, 0), 0, 1.5f}, passed));
    EXPECT_NEAR(passed.chance, std::pow(1 - paneReflectance(1, kIor), 2), 1e-5);
}

TEST(RayPanes, AreNotThereWithoutGlass) {
    const RayScene rays(panes({}));
    EXPECT_FALSE(rays.hasPanes());
    EXPECT_EQ(rays.transmittance({Vec3(0, 1, 0), Vec3(0, -1, 0), 0, 0.5f}).colour, Vec3(1));
}

}  // namespace
}  // namespace vlf
