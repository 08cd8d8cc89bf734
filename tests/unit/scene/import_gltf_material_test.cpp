#include "unit/scene/gltf_document.h"

namespace vlf {
namespace {

using nlohmann::json;
using test::base64;
using test::Document;

class ImportGltfMaterial : public test::GltfTest {};

TEST_F(ImportGltfMaterial, MakesSmoothMetalsMirrors) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {0.9, 0.8, 0.7, 1}},
                                                   {"metallicFactor", 0.75},
                                                   {"roughnessFactor", 0.0}};
    const Scene scene = import(document);
    test::expectNear(scene.material(0).mirror, 0.75f * Vec3(0.9f, 0.8f, 0.7f));
    test::expectNear(scene.material(0).diffuse, 0.25f * Vec3(0.9f, 0.8f, 0.7f));
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltfMaterial, MakesRoughMetalsRoughMirrors) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {0.9, 0.8, 0.7, 1}},
                                                   {"roughnessFactor", 0.4}};
    const Scene scene = import(document);
    test::expectNear(scene.material(0).mirror, {0.9f, 0.8f, 0.7f});
    test::expectNear(scene.material(0).diffuse, Vec3(0));
    EXPECT_FLOAT_EQ(scene.material(0).roughness, 0.16f);
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltfMaterial, MultipliesEmissionByItsStrengthOnBothSidesIfDoubleSided) {
    Document document;
    document.material()["emissiveFactor"] = {1, 0.5, 0.25};
    document.material()["extensions"] = {
        {"KHR_materials_emissive_strength", {{"emissiveStrength", 12}}}};
    const Scene oneSided = import(document);
    test::expectNear(oneSided.material(0).emission, {12, 6, 3});
    EXPECT_FALSE(oneSided.material(0).emitsBothSides);
    document.material()["doubleSided"] = true;
    EXPECT_TRUE(import(document).material(0).emitsBothSides);
}

TEST_F(ImportGltfMaterial, LeavesTransmissiveSurfacesOutWithAWarning) {
    Document document;
    document.root["materials"].push_back(
        {{"name", "glass"},
         {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}});
    json pane = document.primitive();
    pane["material"] = 1;
    pane["attributes"]["POSITION"] =
        document.addFloats({0, 0, 9, 1, 0, 9, 1, 1, 9, 0, 1, 9}, "VEC3");
    document.root["meshes"][0]["primitives"].push_back(pane);
    EXPECT_EQ(import(document).triangles.size(), 2u);
    EXPECT_EQ(warningsWith("materials[1] 'glass': transparency is not supported"), 1);
}

TEST_F(ImportGltfMaterial, ReadsTexturesFromFilesUrisAndBuffers) {
    const std::string picture = pictureBytes(Vec3(0, 1, 0));
    write("sub/my picture.png", picture);
    Document inBuffer;
    const int view = inBuffer.addView(picture);
    const std::pair<Document, json> cases[] = {
        {Document(), {{"uri", "sub/my%20picture.png"}}},
        {Document(), {{"uri", "data:image/png;base64," + base64(picture)}}},
        {inBuffer, {{"bufferView", view}, {"mimeType", "image/png"}}}};
    for (auto [document, image] : cases) {
        document.addTexture(image);
        const Scene scene = import(document);
        ASSERT_EQ(scene.textures.size(), 1u) << image;
        // Vertex 3, the square's top left, has the image's top left, uv (0, 0) in glTF.
        const Vec2 uv = uvAt(scene, 1, Vec2(0, 1)) + Vec2(0.25f, -0.25f);
        test::expectNear(diffuseReflectance(scene, scene.material(1), uv), {0, 1, 0});
    }
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltfMaterial, UsesTheFactorWhereAnImageIsMissingOrDamaged) {
    Document document;
    for (const json& image :
         {json{{"uri", "gone.png"}}, json{{"uri", "data:image/png;base64,AAAA"}},
          json{{"bufferView", 0}, {"mimeType", "image/png"}}}) {
        report_ = {};
        document.addTexture(image);
        const Scene scene = import(document);
        EXPECT_EQ(scene.material(0).diffuseTexture, -1);
        EXPECT_EQ(warningsWith("its factor alone is used"), 1) << image;
    }
    document.addTexture({{"bufferView", 77}});
    errorOf(document);
}

TEST_F(ImportGltfMaterial, AppliesTextureTransformsAndSamplers) {
    Document document;
    document.addTexture({{"uri", "data:image/png;base64," + base64(pictureBytes(Vec3(1)))}});
    document.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    document.root["textures"][0]["sampler"] = 0;
    document.material()["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        {"KHR_texture_transform",
         {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}, {"rotation", kPi / 2}}}};
    const Scene scene = import(document);
    // uv (1, 0) of glTF at vertex 2: scaled to (2, 0), rotated to (0, -2), moved to (0.5, -1.75).
    const Vec2 uv = uvAt(scene, 0, Vec2(0, 1));
    EXPECT_NEAR(uv.x, 0.5f, 1e-5);
    EXPECT_NEAR(uv.y, 1 + 1.75f, 1e-5);
    EXPECT_EQ(scene.textures[0].wrapU, Wrap::clamp);
    EXPECT_EQ(scene.textures[0].wrapV, Wrap::mirror);
}

}  // namespace
}  // namespace vlf
