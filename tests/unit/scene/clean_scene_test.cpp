#include "vlf/scene/import/import.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// Two materials and the triangles (a, b, c, material) over the corners of a tetrahedron.
Scene tetrahedronScene(const std::vector<std::array<std::uint32_t, 4>>& triangles, float size = 1) {
    Scene scene;
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
        scene.positions.push_back(size * p);
    scene.materials.resize(2);
    scene.materials[0].name = "first";
    scene.materials[1].name = "second";
    for (const auto& [a, b, c, material] : triangles)
        scene.triangles.push_back({{a, b, c}, material});
    scene.meshes.push_back({"mesh", 0, static_cast<std::uint32_t>(triangles.size())});
    return scene;
}

TEST(CleanScene, DropsTrianglesWithoutArea) {
    Scene scene = tetrahedronScene({{0, 1, 2, 0}, {0, 1, 1, 0}, {2, 2, 2, 0}, {0, 3, 2, 0}});
    scene.positions.push_back({0.5f, 0, 0});
    scene.triangles.push_back({{0, 1, 4}, 0});
    scene.meshes.push_back({"sliver", 4, 1});
    ImportReport report;
    cleanScene(scene, report);
    EXPECT_EQ(report.degenerateTriangles, 3u);
    EXPECT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.positions.size(), 4u);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].triangleCount, 2u);
}

TEST(CleanScene, KeepsScenesOfAnySize) {
    for (const float size : {1e-6f, 1e-3f, 1e5f}) {
        Scene scene = tetrahedronScene({{0, 2, 1, 0}, {0, 1, 3, 0}}, size);
        ImportReport report;
        cleanScene(scene, report);
        EXPECT_EQ(scene.triangles.size(), 2u) << size;
        EXPECT_NEAR(glm::length(geometricNormal(scene, 0)), 1, 1e-5) << size;
    }
}

TEST(CleanScene, DropsRepeatedTrianglesAtEqualPositions) {
    Scene scene = tetrahedronScene({{0, 1, 2, 0}, {1, 2, 0, 0}, {2, 0, 1, 1}});
    for (int i = 0; i < 3; ++i) scene.positions.push_back(scene.positions[i] * Vec3(1, 1, -1.0f));
    scene.triangles.push_back({{4, 5, 6}, 0});
    scene.meshes[0].triangleCount = 4;
    ImportReport report;
    cleanScene(scene, report);
    EXPECT_EQ(report.duplicateTriangles, 3u);
    ASSERT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.triangles[0].material, 0u) << "the first is kept";
}

TEST(CleanScene, KeepsBothWindingsOnlyIfTheirMaterialsDiffer) {
    Scene same = tetrahedronScene({{0, 1, 2, 0}, {0, 2, 1, 0}, {0, 2, 1, 0}});
    Scene different = tetrahedronScene({{0, 1, 2, 0}, {0, 2, 1, 1}, {2, 1, 0, 1}});
    ImportReport sameReport, differentReport;
    cleanScene(same, sameReport);
    cleanScene(different, differentReport);
    EXPECT_EQ(same.triangles.size(), 1u);
    EXPECT_EQ(sameReport.duplicateTriangles, 2u);
    EXPECT_EQ(different.triangles.size(), 2u);
    EXPECT_EQ(differentReport.duplicateTriangles, 1u);
}

TEST(CleanScene, LetsAnEmitterGivenInBothWindingsShineOnBothSides) {
    Scene scene = tetrahedronScene({{0, 1, 2, 0}, {0, 2, 1, 0}, {0, 2, 1, 0}, {0, 1, 3, 0}});
    scene.materials[0].emission = Vec3(5);
    ImportReport report;
    cleanScene(scene, report);
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_TRUE(scene.material(0).emitsBothSides);
    EXPECT_FALSE(scene.material(1).emitsBothSides) << "other faces of the material stay one-sided";
    EXPECT_EQ(scene.material(0).emission, Vec3(5));
}

TEST(CleanScene, ComputesMissingNormalsAndTurnsThoseBehindTheFace) {
    Scene scene = tetrahedronScene({{0, 1, 2, 0}});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    scene.normals = {Vec3(0), Vec3(nan), Vec3(0, 0, -2), Vec3(0)};
    ImportReport report;
    cleanScene(scene, report);
    for (const Vec3& n : scene.normals) EXPECT_NEAR(glm::distance(n, Vec3(0, 0, 1)), 0, 1e-6);
}

TEST(CleanScene, CountsTheBrightestTexelOfAReflectanceTexture) {
    Scene scene = tetrahedronScene({{0, 1, 2, 0}});
    Texture bright;
    bright.width = bright.height = 1;
    bright.linear = {Vec3(4, 1, 1)};
    scene.textures.push_back(bright);
    scene.materials[0].diffuse = Vec3(0.5f);
    scene.materials[0].diffuseTexture = 0;
    ImportReport report;
    cleanScene(scene, report);
    EXPECT_NEAR(diffuseReflectance(scene, scene.material(0), Vec2(0)).x, 1, 1e-5);
    EXPECT_EQ(report.warnings.size(), 1u);
}

}  // namespace
}  // namespace vlf
