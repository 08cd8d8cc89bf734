#include "vlf/scene/export_obj.h"

#include "vlf/base/error.h"
#include "vlf/scene/generate/generate.h"
#include "vlf/scene/import/import.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace vlf {
namespace {

namespace fs = std::filesystem;

/// A fresh folder that goes with the test.
class ExportObj : public testing::Test {
  protected:
    ExportObj() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(testing::TempDir()) /
                  ("vlf-export-" + std::string(info->name()) + "-" + std::to_string(::getpid()));
        fs::remove_all(folder_);
    }
    ~ExportObj() override { fs::remove_all(folder_); }

    Scene roundTrip(const Scene& scene) {
        exportObj(scene, folder_.string(), "room");
        return importScene({(folder_ / "room.obj").string()}, report_);
    }

    fs::path folder_;
    ImportReport report_;
};

void expectSameTexture(const Scene& a, int textureA, const Scene& b, int textureB) {
    ASSERT_EQ(textureA < 0, textureB < 0);
    if (textureA < 0) return;
    const Texture &x = a.textures[textureA], &y = b.textures[textureB];
    EXPECT_EQ(x.width, y.width);
    EXPECT_EQ(x.height, y.height);
    EXPECT_EQ(x.wrapU, y.wrapU);
    EXPECT_EQ(x.wrapV, y.wrapV);
    EXPECT_EQ(x.srgb8, y.srgb8);
    EXPECT_EQ(x.linear, y.linear);
}

void expectSameMaterial(const Scene& a, const Material& x, const Scene& b, const Material& y) {
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.diffuse, y.diffuse) << x.name;
    EXPECT_EQ(x.mirror, y.mirror) << x.name;
    EXPECT_EQ(x.emission, y.emission) << x.name;
    EXPECT_EQ(x.transmission, y.transmission) << x.name;
    if (x.isGlass()) {
        EXPECT_EQ(x.ior, y.ior) << x.name;
        EXPECT_EQ(x.thin, y.thin) << x.name;
    }
    expectSameTexture(a, x.diffuseTexture, b, y.diffuseTexture);
    expectSameTexture(a, x.mirrorTexture, b, y.mirrorTexture);
    expectSameTexture(a, x.emissionTexture, b, y.emissionTexture);
}

void expectSameMeshes(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        EXPECT_EQ(a.meshes[i].name, b.meshes[i].name);
        EXPECT_EQ(a.meshes[i].firstTriangle, b.meshes[i].firstTriangle);
        EXPECT_EQ(a.meshes[i].triangleCount, b.meshes[i].triangleCount);
    }
}

void expectSameCameras(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        EXPECT_EQ(a.cameras[i].name, b.cameras[i].name);
        EXPECT_EQ(a.cameras[i].eye, b.cameras[i].eye);
        EXPECT_EQ(a.cameras[i].look, b.cameras[i].look);
        EXPECT_EQ(a.cameras[i].up, b.cameras[i].up);
        EXPECT_EQ(a.cameras[i].verticalFov, b.cameras[i].verticalFov);
    }
}

void expectSameTriangles(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t i = a.triangles[t].vertex[k], j = b.triangles[t].vertex[k];
            ASSERT_EQ(a.positions[i], b.positions[j]) << t;
            ASSERT_EQ(a.uvs[i], b.uvs[j]) << t;
            ASSERT_LT(glm::distance(a.normals[i], b.normals[j]), 1e-6f) << t;
        }
        const auto triangle = static_cast<std::uint32_t>(t);
        ASSERT_EQ(a.material(triangle).name, b.material(triangle).name);
    }
}

void expectSameScene(const Scene& a, const Scene& b) {
    expectSameTriangles(a, b);
    expectSameMeshes(a, b);
    expectSameCameras(a, b);
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (const Material& x : a.materials) {
        const auto y = std::find_if(b.materials.begin(), b.materials.end(),
                                    [&](const Material& m) { return m.name == x.name; });
        ASSERT_NE(y, b.materials.end()) << x.name;
        expectSameMaterial(a, x, b, *y);
    }
}

TEST_F(ExportObj, IsReadBackAsTheSameScene) {
    for (const SceneRecipe& recipe : sceneRecipes()) {
        SCOPED_TRACE(recipe.name);
        const Scene scene = generateScene(recipe.name);
        report_ = {};
        expectSameScene(scene, roundTrip(scene));
        EXPECT_TRUE(report_.warnings.empty()) << report_.warnings.front();
        EXPECT_EQ(report_.degenerateTriangles, 0u);
        EXPECT_EQ(report_.duplicateTriangles, 0u);
    }
}

TEST_F(ExportObj, KeepsHighDynamicRangeTextures) {
    Scene scene = generateScene("cornell");
    scene.textures.push_back(
        {"glow", 2, 1, {}, {{40, 0.25f, 0}, {1e-3f, 7, 3}}, Wrap::clamp, Wrap::clamp});
    for (Material& m : scene.materials)
        if (m.isEmitter()) m.emissionTexture = 0;
    expectSameScene(scene, roundTrip(scene));
}

TEST_F(ExportObj, GivesEqualNamesNumbersAndCleansThem) {
    Scene scene = generateScene("cornell");
    for (Material& m : scene.materials) m.name = "my paint/1";
    for (Mesh& m : scene.meshes) m.name.clear();
    const Scene back = roundTrip(scene);
    ASSERT_EQ(back.materials.size(), scene.materials.size());
    EXPECT_EQ(back.meshes.size(), scene.meshes.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        EXPECT_EQ(back.material(t).diffuse, scene.material(t).diffuse);
}

TEST_F(ExportObj, LeavesNoOtherFilesBehind) {
    exportObj(generateScene("cornell"), folder_.string(), "box");
    exportObj(generateScene("cornell"), folder_.string(), "box");
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"box.cameras.json", "box.mtl", "box.obj"}));
}

TEST_F(ExportObj, RefusesWhatObjCannotHoldBeforeItWrites) {
    Scene scene = generateScene("cornell");
    scene.materials[0].emitsBothSides = true;
    EXPECT_THROW(exportObj(scene, folder_.string(), "box"), InputError);
    scene = generateScene("gallery");
    scene.textures[0].wrapV = Wrap::mirror;
    EXPECT_THROW(exportObj(scene, folder_.string(), "box"), InputError);
    EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(ExportObj, ReportsAFolderThatCannotBeMade) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "file") << "x";
    EXPECT_THROW(exportObj(generateScene("cornell"), (folder_ / "file" / "sub").string(), "box"),
                 FileError);
}

}  // namespace
}  // namespace vlf
