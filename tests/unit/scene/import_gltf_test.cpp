#include "unit/scene/gltf_document.h"

namespace vlf {
namespace {

using nlohmann::json;
using test::bytesOf;
using test::Document;

class ImportGltf : public test::GltfTest {};

TEST_F(ImportGltf, ReadsTextAndBinaryFiles) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {0.1, 0.2, 0.3, 1}},
                                                   {"metallicFactor", 0}};
    for (const std::string& file :
         {write("a.gltf", document.gltf()), write("b.glb", document.glb())}) {
        const Scene scene = ImportTest::import(file);
        ASSERT_EQ(scene.triangles.size(), 2u);
        EXPECT_NEAR(test::totalArea(scene), 1, 1e-6);
        test::expectNear(geometricNormal(scene, 0), {0, 0, 1});
        test::expectNear(scene.normals[0], {0, 0, 1});
        test::expectNear(scene.material(0).diffuse, {0.1f, 0.2f, 0.3f});
    }
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltf, ComposesNodeTransforms) {
    Document document;
    const double half = std::sqrt(0.5);
    document.root["nodes"] = {
        {{"children", {1}}, {"translation", {10, 0, 0}}, {"rotation", {0, half, 0, half}}},
        {{"mesh", 0}, {"scale", {2, 3, 1}}}};
    const Scene scene = import(document);
    EXPECT_NEAR(test::totalArea(scene), 6, 1e-4);
    test::expectNear(boundsOf(scene).lower, {10, 0, -2});
    test::expectNear(geometricNormal(scene, 0), {1, 0, 0});
}

TEST_F(ImportGltf, KeepsTheFrontUnderReflections) {
    Document document;
    document.primitive()["attributes"]["NORMAL"] =
        document.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    for (const json& scale : {json{-1, 1, 1}, json{-1, -2, 1}, json{1, 1, -1}, json{-1, -1, -1}}) {
        document.node()["scale"] = scale;
        const Scene scene = import(document);
        const Vec3 front(0, 0, scale[2].get<float>());
        for (std::uint32_t t = 0; t < 2; ++t) {
            test::expectNear(geometricNormal(scene, t), front);
            test::expectNear(shadingNormalAt(scene, t, Vec2(0.3f)), front);
        }
    }
}

TEST_F(ImportGltf, TurnsStripsAndFansIntoTriangles) {
    for (const int mode : {5, 6}) {
        Document document;
        document.primitive()["mode"] = mode;
        document.primitive()["indices"] =
            document.addIndices(mode == 5 ? std::vector<std::uint16_t>{0, 1, 3, 2}
                                          : std::vector<std::uint16_t>{0, 1, 2, 3});
        const Scene scene = import(document);
        ASSERT_EQ(scene.triangles.size(), 2u);
        for (std::uint32_t t = 0; t < 2; ++t)
            test::expectNear(geometricNormal(scene, t), {0, 0, 1});
    }
}

TEST_F(ImportGltf, SkipsPointsAndLinesWithAWarning) {
    Document document;
    json lines = document.primitive();
    lines["mode"] = 1;
    document.root["meshes"][0]["primitives"].push_back(lines);
    EXPECT_EQ(import(document).triangles.size(), 2u);
    EXPECT_EQ(warningsWith("meshes[0].primitives[1]: points and lines are skipped"), 1);
}

TEST_F(ImportGltf, ReadsQuantizedAndSparseAccessors) {
    Document document;
    const std::vector<std::uint16_t> corners{0,     0,     0, 0, 65535, 0, 0, 0,
                                             65535, 65535, 0, 0, 0,     0, 0, 0};
    const int positions = document.addAccessor(bytesOf(corners), 5123, 4, "VEC3");
    json& accessor = document.root["accessors"][positions];
    accessor["normalized"] = true;
    document.root["bufferViews"][accessor["bufferView"].get<int>()]["byteStride"] = 8;
    const int where = document.addView(bytesOf(std::vector<std::uint16_t>{3}));
    const int what = document.addView(bytesOf(std::vector<std::uint16_t>{0, 65535, 0}));
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                          {"values", {{"bufferView", what}}}};
    document.primitive()["attributes"]["POSITION"] = positions;
    document.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_NEAR(test::totalArea(import(document)), 1, 1e-5);
    accessor["sparse"]["indices"]["bufferView"] =
        document.addView(bytesOf(std::vector<std::uint16_t>{4}));
    expectError(document, "sparse index");
}

TEST_F(ImportGltf, TakesAllRootNodesWhereThereIsNoScene) {
    Document document;
    document.root.erase("scenes");
    document.root.erase("scene");
    document.root["nodes"] = {{{"mesh", 0}, {"translation", {0, 0, 3}}}, {{"mesh", 0}}};
    EXPECT_EQ(import(document).triangles.size(), 4u);
}

TEST_F(ImportGltf, WarnsOfOptionalExtensions) {
    Document document;
    document.root["extensionsUsed"] = {"KHR_lights_punctual", "VENDOR_unheard_of"};
    document.root["extensionsRequired"] = {"KHR_lights_punctual"};
    EXPECT_EQ(import(document).triangles.size(), 2u);
    EXPECT_EQ(report_.warnings.size(), 1u);
    EXPECT_EQ(warningsWith("VENDOR_unheard_of is not supported"), 1);
}

TEST_F(ImportGltf, ReadsPerspectiveCamerasWithTheirPose) {
    Document document;
    document.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", kPi / 3}, {"znear", 0.1}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 0.1}}}}};
    document.root["nodes"].push_back({{"name", "eye"},
                                      {"camera", 0},
                                      {"translation", {1, 2, 3}},
                                      {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}},
                                      {"scale", {2, 2, 2}}});
    document.root["nodes"].push_back({{"camera", 1}});
    document.root["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = import(document);
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "eye");
    EXPECT_NEAR(camera.verticalFov, 60, 1e-4);
    test::expectNear(camera.eye, {1, 2, 3});
    test::expectNear(camera.look - camera.eye, {-1, 0, 0});
    test::expectNear(camera.up, {0, 1, 0});
    EXPECT_EQ(warningsWith("orthographic"), 1);
}

}  // namespace
}  // namespace vlf
