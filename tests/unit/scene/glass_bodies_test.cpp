#include "vlf/scene/import/glass_bodies.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <array>

namespace vlf {
namespace {

using test::SceneBuilder;

std::uint32_t glass(SceneBuilder& b, const Vec3& transmission = Vec3(0.81f)) {
    const std::uint32_t m = b.material("glass", Vec3(0));
    b.scene().materials[m].transmission = transmission;
    return m;
}

Scene sorted(Scene scene, std::uint32_t material) {
    sortGlass(scene, std::array{material});
    return scene;
}

double volumeOf(const Scene& scene, std::uint32_t first, std::uint32_t count) {
    double sum = 0;
    for (std::uint32_t t = first; t < first + count; ++t)
        sum +=
            glm::dot(scene.position(t, 0), glm::cross(scene.position(t, 1), scene.position(t, 2)));
    return sum / 6;
}

TEST(SortGlass, TakesClosedBodiesForSolids) {
    SceneBuilder b;
    const std::uint32_t m = glass(b);
    b.box(Vec3(0), Vec3(1), false, m);
    const Scene scene = sorted(b.scene(), m);
    EXPECT_FALSE(scene.materials[m].thin);
    // Light passes two surfaces of a solid.
    EXPECT_NEAR(scene.materials[m].transmission.x, 0.9f, 1e-6);
}

TEST(SortGlass, TakesOpenSurfacesForPanes) {
    SceneBuilder b;
    const std::uint32_t m = glass(b);
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, m);
    b.box(Vec3(2), Vec3(3), false, m);
    b.scene().triangles.pop_back();  // a box with a hole
    --b.scene().meshes.back().triangleCount;
    const Scene scene = sorted(b.scene(), m);
    EXPECT_TRUE(scene.materials[m].thin);
    EXPECT_EQ(scene.materials[m].transmission.x, 0.81f);
    EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(SortGlass, TellsPiecesOfOneMaterialApart) {
    SceneBuilder b;
    const std::uint32_t m = glass(b);
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, m);
    b.sphere(Vec3(5), 1, 1, false, m);
    const Scene scene = sorted(b.scene(), m);
    ASSERT_EQ(scene.materials.size(), 2u);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        EXPECT_EQ(scene.material(t).thin, t < 2) << t;
}

TEST(SortGlass, TakesAPaneModelledFromBothSidesForAPane) {
    SceneBuilder b;
    const std::uint32_t m = glass(b);
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, m);
    const std::vector<Triangle> front = b.scene().triangles;
    for (Triangle t : front) {
        std::swap(t.vertex[0], t.vertex[1]);
        b.scene().triangles.push_back(t);
    }
    EXPECT_TRUE(sorted(b.scene(), m).materials[m].thin);
}

TEST(SortGlass, TurnsSolidsThatAreInsideOut) {
    for (const bool inwards : {false, true}) {
        SceneBuilder b;
        const std::uint32_t m = glass(b);
        b.sphere({1, 2, 3}, 1, 2, inwards, m);
        const Scene scene = sorted(b.scene(), m);
        EXPECT_GT(volumeOf(scene, 0, static_cast<std::uint32_t>(scene.triangles.size())), 3.5);
    }
}

TEST(SortGlass, WindsTheTrianglesOfASolidAlike) {
    SceneBuilder b;
    const std::uint32_t m = glass(b);
    b.box(Vec3(1), Vec3(2), false, m);
    for (const std::size_t t : {1u, 4u, 7u})
        std::swap(b.scene().triangles[t].vertex[1], b.scene().triangles[t].vertex[2]);
    const Scene scene = sorted(b.scene(), m);
    EXPECT_NEAR(volumeOf(scene, 0, 12), 1, 1e-5);
}

TEST(SortGlass, LeavesTheSurfacesOfCavitiesAsTheyAre) {
    SceneBuilder b;
    const std::uint32_t m = glass(b);
    b.sphere(Vec3(0), 1, 2, false, m);
    b.sphere(Vec3(0), 0.8f, 2, true, m);  // its front is the air within
    const std::uint32_t outer = b.scene().meshes[0].triangleCount;
    const Scene scene = sorted(b.scene(), m);
    EXPECT_GT(volumeOf(scene, 0, outer), 0);
    EXPECT_LT(volumeOf(scene, outer, outer), 0);
}

TEST(SortGlass, LeavesOtherMaterialsAlone) {
    SceneBuilder b;
    const std::uint32_t m = glass(b), other = b.material("other", Vec3(0.5f));
    b.box(Vec3(0), Vec3(1), true, other);
    b.quad(Vec3(0.5f), {0.1f, 0, 0}, {0, 0.1f, 0}, m);
    const Scene before = b.scene();
    const Scene scene = sorted(before, m);
    for (std::size_t t = 0; t < 12; ++t)
        EXPECT_EQ(scene.triangles[t].vertex, before.triangles[t].vertex);
}

}  // namespace
}  // namespace vlf
