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

TEST_F(ImportGltfMaterial, MakesTransmissiveSurfacesPanesOrSolidsAsTheyHaveAVolume) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {
        {"baseColorFactor", {0.9, 0.8, 0.7, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0}};
    document.material()["extensions"] = {
        {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
        {"KHR_materials_ior", {{"ior", 1.4}}}};
    const Scene pane = import(document);
    test::expectNear(pane.material(0).transmission, {0.9f, 0.8f, 0.7f});
    EXPECT_FLOAT_EQ(pane.material(0).ior, 1.4f);
    EXPECT_TRUE(pane.material(0).isPane());
    EXPECT_TRUE(report_.warnings.empty());
    document.material()["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 0.1},
                                                                 {"attenuationDistance", 0.5}};
    EXPECT_TRUE(import(document).material(0).isSolidGlass());
    EXPECT_EQ(warningsWith("attenuation within glass is left out"), 1);
}

TEST_F(ImportGltfMaterial, TakesTheMeanOfTransmissionTextures) {
    Document document;
    document.addTexture({{"uri", "half.png"}});
    Image half(2, 2, Vec3(1));
    writePng(path("half.png"), half);
    document.material()["extensions"] = {
        {"KHR_materials_transmission",
         {{"transmissionFactor", 0.8}, {"transmissionTexture", {{"index", 0}}}}}};
    test::expectNear(import(document).material(0).transmission, Vec3(0.8f));
    EXPECT_EQ(warningsWith("glass in part"), 1);
    EXPECT_EQ(warningsWith("rough glass is shown as smooth"), 1);
    document
        .material()["extensions"]["KHR_materials_transmission"]["transmissionTexture"]["index"] = 5;
    expectError(document, "textures[5] does not exist");
}

TEST_F(ImportGltfMaterial, KeepsOpaqueWhatLetsLittleThrough) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    document.material()["extensions"] = {
        {"KHR_materials_transmission", {{"transmissionFactor", 0.3}}}};
    EXPECT_FALSE(import(document).material(0).isGlass());
    EXPECT_EQ(warningsWith("transparency is not supported; treated as opaque"), 1);
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

/// A picture in BMP whose left half is transparent.
std::string halfTransparent() {
    constexpr int kSize = 32, kHeader = 122;  // BITMAPV4HEADER
    std::string bytes(kHeader + 4 * kSize * kSize, '\0');
    const auto put = [&](std::size_t at, std::uint32_t value) {
        std::memcpy(&bytes[at], &value, 4);
    };
    bytes[0] = 'B';
    bytes[1] = 'M';
    put(2, static_cast<std::uint32_t>(bytes.size()));
    put(10, kHeader);
    put(14, 108);
    put(18, kSize);
    put(22, kSize);
    put(26, 1 | 32 << 16);
    put(30, 3);
    put(54, 0xff0000);
    put(58, 0xff00);
    put(62, 0xff);
    put(66, 0xff000000);
    for (std::size_t i = 0; i < kSize * kSize; ++i)
        put(kHeader + 4 * i, i % kSize < kSize / 2 ? 0x00ffffff : 0xffffffff);
    return bytes;
}

class ImportGltfMask : public test::GltfTest {
  protected:
    Document document() {
        Document result;
        result.addTexture({{"uri", "half.bmp"}});
        result.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33071}}};
        result.root["textures"][0]["sampler"] = 0;
        write("half.bmp", halfTransparent());
        return result;
    }
};

TEST_F(ImportGltfMask, IsOpaqueUnlessTheAlphaModeSaysOtherwise) {
    EXPECT_EQ(test::totalArea(import(document())), 1.0f);
}

TEST_F(ImportGltfMask, CutsHolesWhereAlphaIsBelowTheCutoff) {
    Document masked = document();
    masked.material()["alphaMode"] = "MASK";
    EXPECT_NEAR(test::totalArea(import(masked)), 0.5f, 0.01f);
    masked.material()["alphaCutoff"] = 0;
    EXPECT_EQ(test::totalArea(import(masked)), 1.0f);
    masked.material()["alphaCutoff"] = 0.9;
    masked.material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.8};
    masked.primitive()["material"] = 0;
    EXPECT_NE(errorOf(masked).find("no triangle"), std::string::npos);
    EXPECT_EQ(warningsWith("transparent all over"), 1);
}

TEST_F(ImportGltfMask, MakesBlendingAMaskWithAWarning) {
    Document blended = document();
    blended.material()["alphaMode"] = "BLEND";
    EXPECT_NEAR(test::totalArea(import(blended)), 0.5f, 0.01f);
    EXPECT_EQ(warningsWith("blending is not supported"), 1);
}

TEST_F(ImportGltfMask, KeepsItsCoordinatesWhereVertexColoursArePainted) {
    Document coloured = document();
    coloured.material()["alphaMode"] = "MASK";
    coloured.primitive()["attributes"]["COLOR_0"] =
        coloured.addFloats({1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, "VEC3");
    const Scene scene = import(coloured);
    EXPECT_NEAR(test::totalArea(scene), 0.5f, 0.01f);
    for (const Vec3& p : scene.positions) EXPECT_GT(p.x, 0.48f);
    const Vec3 corner = diffuseReflectance(scene, scene.material(0), scene.uvs[0]);
    EXPECT_LT(maxComponent(corner), 1.01f);
}

}  // namespace
}  // namespace vlf
