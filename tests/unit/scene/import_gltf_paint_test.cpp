// Vertex colours, and emission textures with coordinates of their own.

#include "unit/scene/gltf_document.h"

namespace vlf {
namespace {

using nlohmann::json;
using test::bytesOf;
using test::Document;

/// A few points of a triangle, its corners among them.
const std::vector<Vec2> kPoints{{0, 0}, {1, 0}, {0, 1}, {0.5f, 0.5f}, {0.3f, 0.1f}, {0.2f, 0.7f}};

/// What the texels of a sheet, which lie otherwise than the picture's, may blur a texel from its
/// edges.
constexpr float kBlur = 0.025f;

class ImportGltfPaint : public test::GltfTest {
  protected:
    /// Calls check(position, reflectance, radiance) at points of all triangles.
    template <class Check>
    static void atPoints(const Scene& scene, Check check) {
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
            for (const Vec2& b : kPoints) {
                const Vec2 uv = uvAt(scene, t, b);
                check(positionAt(scene, t, b), diffuseReflectance(scene, scene.material(t), uv),
                      emittedRadiance(scene, scene.material(t), uv));
            }
    }

    /// Whether the halves of the picture meet there, or its repetitions.
    static bool isAtEdge(float t) { return std::abs(2 * t - std::round(2 * t)) < 0.1f; }

    /// A picture of 16 pixels along u that is `from` in its left half and `to` in the right one.
    json twoHalves(const Vec3& from, const Vec3& to) {
        Image picture(16, 1, from);
        for (int x = 8; x < 16; ++x) picture.at(x, 0) = to;
        writePng(path("halves.png"), picture);
        return {{"uri", "halves.png"}};
    }

    static void setColors(Document& document, const std::vector<float>& colors) {
        document.primitive()["attributes"]["COLOR_0"] = document.addFloats(colors, "VEC3");
    }
};

TEST_F(ImportGltfPaint, MultipliesReflectancesByAColourThatIsTheSameEverywhere) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {
        {"baseColorFactor", {0.8, 0.8, 0.8, 1}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0}};
    setColors(document, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    const Scene white = import(document);
    EXPECT_EQ(white.materials.size(), 1u);
    setColors(document, {1, 0.5f, 0, 1, 0.5f, 0, 1, 0.5f, 0, 1, 0.5f, 0});
    const Scene scene = import(document);
    test::expectNear(scene.material(0).diffuse, {0.4f, 0.2f, 0});
    test::expectNear(scene.material(0).mirror, {0.4f, 0.2f, 0});
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltfPaint, InterpolatesColoursExactly) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {0.5, 1, 1, 1}},
                                                   {"metallicFactor", 0}};
    // Red along x, green against it, blue along y.
    setColors(document, {0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 1, 1});
    const Scene scene = import(document);
    atPoints(scene, [](const Vec3& p, const Vec3& reflectance, const Vec3&) {
        test::expectNear(reflectance, Vec3(0.5f * p.x, 1 - p.x, p.y), 1e-4f);
    });
}

TEST_F(ImportGltfPaint, InterpolatesColoursThatNoOrderOfCornersMakesExactClosely) {
    Document document;
    const std::vector<Vec3> corners{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 0}};
    std::vector<float> colors;
    for (const Vec3& c : corners) colors.insert(colors.end(), {c.x, c.y, c.z});
    document.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    setColors(document, colors);
    const Scene scene = import(document);
    for (const Vec2& b : kPoints) {
        const Vec3 expected = (1 - b.x - b.y) * corners[0] + b.x * corners[1] + b.y * corners[2];
        test::expectNear(diffuseReflectance(scene, scene.material(0), uvAt(scene, 0, b)), expected,
                         0.04f);
    }
}

TEST_F(ImportGltfPaint, ReadsColoursAsBytesWithAlpha) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    const int colors =
        document.addAccessor(bytesOf(std::vector<std::uint8_t>{0, 0, 0, 9, 255, 0, 0, 9,  //
                                                               255, 0, 0, 9, 0, 0, 0, 9}),
                             5121, 4, "VEC4");
    document.root["accessors"][colors]["normalized"] = true;
    document.primitive()["attributes"]["COLOR_0"] = colors;
    atPoints(import(document), [](const Vec3& p, const Vec3& reflectance, const Vec3&) {
        test::expectNear(reflectance, Vec3(p.x, 0, 0), 1e-4f);
    });
}

TEST_F(ImportGltfPaint, MultipliesTexturesByColours) {
    Document document;
    document.addTexture(twoHalves(Vec3(1, 0, 0), Vec3(0, 1, 0)));
    setColors(document, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1});  // along y
    const Scene scene = import(document);
    atPoints(scene, [](const Vec3& p, const Vec3& reflectance, const Vec3&) {
        if (isAtEdge(p.x)) return;
        test::expectNear(reflectance, p.y * (p.x < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0)), kBlur);
    });
}

TEST_F(ImportGltfPaint, GivesEveryInstanceTheSameTextures) {
    Document document;
    setColors(document, {0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0});
    document.root["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 1}}});
    document.root["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = import(document);
    ASSERT_EQ(scene.triangles.size(), 4u);
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(uvAt(scene, 0, Vec2(0.3f)), uvAt(scene, 2, Vec2(0.3f)));
}

TEST_F(ImportGltfPaint, StaysWithinItsSize) {
    Document document;
    document.addTexture(twoHalves(Vec3(1, 0, 0), Vec3(0, 1, 0)));
    setColors(document, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1});
    document.primitive()["attributes"]["TEXCOORD_0"] =
        document.addFloats({0, 0, 1e6f, 0, 1e6f, 1e6f, 0, 1e6f}, "VEC2");
    std::vector<std::uint16_t> indices;
    for (int i = 0; i < 500; ++i) indices.insert(indices.end(), {0, 1, 2, 0, 2, 3});
    document.primitive()["indices"] = document.addIndices(indices);
    const Scene scene = import(document);
    const Texture& painted = scene.textures.back();
    EXPECT_GT(painted.linear.size(), 1u << 21);
    EXPECT_LT(painted.linear.size(), 1u << 23);
}

TEST_F(ImportGltfPaint, GivesTheEmissionTextureItsOwnCoordinates) {
    Document document;
    document.addTexture(twoHalves(Vec3(1, 0, 0), Vec3(0, 1, 0)));
    document.material()["emissiveFactor"] = {1, 1, 1};
    document.material()["emissiveTexture"] = {{"index", 0}};
    const auto expectEmission = [&](auto isRed) {
        atPoints(import(document), [&](const Vec3& p, const Vec3& reflectance, const Vec3& e) {
            if (isAtEdge(p.x) || isAtEdge(p.y)) return;
            test::expectNear(reflectance, p.x < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0), kBlur);
            test::expectNear(e, isRed(p) ? Vec3(1, 0, 0) : Vec3(0, 1, 0), kBlur);
        });
        EXPECT_TRUE(report_.warnings.empty());
    };
    expectEmission([](const Vec3& p) { return p.x < 0.5f; });
    document.material()["emissiveTexture"]["extensions"] = {
        {"KHR_texture_transform", {{"offset", {0.5, 0}}}}};
    expectEmission([](const Vec3& p) { return p.x > 0.5f; });
    document.material()["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    document.primitive()["attributes"]["TEXCOORD_1"] =
        document.addFloats({0, 0, 0, 0, 1, 0, 1, 0}, "VEC2");  // u along y
    expectEmission([](const Vec3& p) { return p.y < 0.5f; });
}

TEST_F(ImportGltfPaint, NeedsNoPaintForAnEmissionTextureAlone) {
    Document document;
    document.addTexture(twoHalves(Vec3(1, 0, 0), Vec3(0, 1, 0)));
    document.material()["pbrMetallicRoughness"].erase("baseColorTexture");
    document.material()["emissiveFactor"] = {1, 1, 1};
    document.material()["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    document.primitive()["attributes"]["TEXCOORD_1"] =
        document.addFloats({0.25f, 0, 0.25f, 0, 0.25f, 0, 0.25f, 0}, "VEC2");
    const Scene scene = import(document);
    EXPECT_EQ(scene.textures.size(), 1u);
    atPoints(scene, [](const Vec3&, const Vec3&, const Vec3& e) {
        test::expectNear(e, {1, 0, 0}, kBlur);
    });
}

TEST_F(ImportGltfPaint, NamesColoursThatCannotBeUsed) {
    Document document;
    setColors(document, {0, 0, 0, 1, 1, 1});
    expectError(document, "meshes[0].primitives[0].COLOR_0: 2 elements for 4 vertices");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    setColors(document, {0, 0, 0, 1, 1, 1, 0, nan, 0, 0, 0, 0});
    expectError(document, "meshes[0].primitives[0].COLOR_0: element 2 is not finite");
}

}  // namespace
}  // namespace vlf
