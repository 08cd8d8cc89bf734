#include "unit/scene/import_support.h"
#include "vlf/image/image_io.h"

#include <nlohmann/json.hpp>

#include <cstring>

namespace vlf {
namespace {

using nlohmann::json;

std::string base64(const std::string& bytes) {
    static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

template <class T>
std::string bytesOf(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// Builds a document with one buffer; a unit square facing +z to begin with.
class Document {
  public:
    Document() {
        root = {{"asset", {{"version", "2.0"}}},      {"scene", 0},
                {"scenes", {{{"nodes", {0}}}}},       {"nodes", {{{"mesh", 0}}}},
                {"materials", {{{"name", "paint"}}}}, {"accessors", json::array()},
                {"bufferViews", json::array()}};
        const int positions = addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
        const int indices = addIndices({0, 1, 2, 0, 2, 3});
        root["meshes"] = {{{"primitives",
                            {{{"attributes", {{"POSITION", positions}}},
                              {"indices", indices},
                              {"material", 0}}}}}};
    }

    json& node() { return root["nodes"][0]; }
    json& primitive() { return root["meshes"][0]["primitives"][0]; }
    json& material() { return root["materials"][0]; }

    int addView(const std::string& bytes) {
        while (buffer_.size() % 4) buffer_ += '\0';
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}});
        buffer_ += bytes;
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }

    int addAccessor(const std::string& bytes, int componentType, std::size_t count,
                    const std::string& type) {
        root["accessors"].push_back({{"bufferView", addView(bytes)},
                                     {"componentType", componentType},
                                     {"count", count},
                                     {"type", type}});
        return static_cast<int>(root["accessors"].size()) - 1;
    }

    int addFloats(const std::vector<float>& values, const std::string& type) {
        const std::size_t components = type == "VEC3" ? 3 : type == "VEC2" ? 2 : 1;
        return addAccessor(bytesOf(values), 5126, values.size() / components, type);
    }

    int addIndices(const std::vector<std::uint16_t>& values) {
        return addAccessor(bytesOf(values), 5123, values.size(), "SCALAR");
    }

    /// Texture coordinates that map the square onto the whole image, and a texture of the image.
    void addTexture(const json& image) {
        primitive()["attributes"]["TEXCOORD_0"] = addFloats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
        root["images"] = {image};
        root["textures"] = {{{"source", 0}}};
        material()["pbrMetallicRoughness"] = {{"metallicFactor", 0},
                                              {"baseColorTexture", {{"index", 0}}}};
    }

    std::string gltf() const {
        json all = root;
        all["buffers"] = {{{"byteLength", buffer_.size()},
                           {"uri", "data:application/octet-stream;base64," + base64(buffer_)}}};
        return all.dump();
    }

    std::string glb() const {
        json all = root;
        all["buffers"] = {{{"byteLength", buffer_.size()}}};
        std::string text = all.dump(), bytes = buffer_;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        const auto u32 = [](std::size_t n) {
            return bytesOf(std::vector<std::uint32_t>{static_cast<std::uint32_t>(n)});
        };
        return "glTF" + u32(2) + u32(28 + text.size() + bytes.size()) + u32(text.size()) + "JSON" +
               text + u32(bytes.size()) + std::string("BIN\0", 4) + bytes;
    }

    json root;

  private:
    std::string buffer_;
};

Vec2 boundsOfUvs(const Scene& scene) {
    Vec2 upper(-1e9f);
    for (const Vec2& uv : scene.uvs) upper = glm::max(upper, uv);
    return upper;
}

class ImportGltf : public test::ImportTest {
  protected:
    Scene import(const Document& document) {
        return ImportTest::import(write("a.gltf", document.gltf()));
    }
    std::string errorOf(const Document& document) {
        return ImportTest::errorOf(write("a.gltf", document.gltf()));
    }
    void expectError(const Document& document, const std::string& part) {
        const std::string message = errorOf(document);
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_NE(message.find("a.gltf"), std::string::npos) << message;
    }
    std::string pictureBytes(const Vec3& colour) {
        Image picture(2, 2, Vec3(0));
        picture.at(0, 0) = colour;  // top left
        writePng(path("picture.png"), picture);
        std::ifstream file(path("picture.png"), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
};

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

TEST_F(ImportGltf, RejectsReferencesAndDataOutOfBounds) {
    const auto broken = [](const std::function<void(Document&)>& damage) {
        Document document;
        damage(document);
        return document;
    };
    expectError(broken([](auto& d) { d.root["accessors"][0]["count"] = 5; }), "do not fit");
    expectError(broken([](auto& d) { d.root["accessors"][0]["count"] = 1ull << 62; }),
                "do not fit");
    expectError(broken([](auto& d) { d.root["accessors"][0]["byteOffset"] = ~0ull - 3; }),
                "do not fit");
    expectError(broken([](auto& d) { d.root["accessors"][0]["type"] = "VEC4"; }), "components");
    expectError(broken([](auto& d) { d.root["accessors"][0]["componentType"] = 5130; }),
                "component type");
    expectError(broken([](auto& d) {
                    d.root["accessors"][0].erase("bufferView");
                    d.root["accessors"][0]["count"] = 1ull << 40;
                }),
                "no data");
    expectError(broken([](auto& d) { d.root["bufferViews"][0]["byteLength"] = 1000; }), "outside");
    expectError(broken([](auto& d) { d.root["bufferViews"][0]["byteOffset"] = ~0ull; }), "outside");
    expectError(broken([](auto& d) { d.root["bufferViews"][0]["buffer"] = 7; }), "buffers[7]");
    expectError(broken([](auto& d) { d.root["accessors"][0]["bufferView"] = 9; }),
                "bufferViews[9]");
    expectError(broken([](auto& d) { d.primitive()["indices"] = d.addIndices({0, 1, 4}); }),
                "meshes[0].primitives[0].indices: index 4");
    expectError(broken([](auto& d) { d.primitive()["attributes"]["POSITION"] = 33; }),
                "accessors[33]");
    expectError(broken([](auto& d) {
                    d.primitive()["attributes"]["NORMAL"] = d.addFloats({0, 0, 1}, "VEC3");
                }),
                "1 elements for 4 vertices");
    expectError(broken([](auto& d) { d.primitive()["material"] = 2; }), "materials[2]");
    expectError(broken([](auto& d) { d.node()["mesh"] = 2; }), "meshes[2]");
    expectError(broken([](auto& d) { d.root["scene"] = 3; }), "scenes[3]");
    expectError(broken([](auto& d) { d.root["scenes"][0]["nodes"] = {5}; }), "nodes[5]");
    expectError(broken([](auto& d) { d.node()["scale"] = {1, 2}; }), "nodes[0]");
    expectError(broken([](auto& d) { d.node()["scale"] = {1e300, 1, 1}; }), "not finite");
}

TEST_F(ImportGltf, NamesTheBufferThatIsAtFault) {
    const auto errorOfBuffers = [&](const json& buffers) {
        json root = Document().root;
        root["buffers"] = buffers;
        return ImportTest::errorOf(write("a.gltf", root.dump()));
    };
    const json good = {{"byteLength", 4}, {"uri", "data:application/octet-stream;base64,AAAA"}};
    EXPECT_NE(errorOfBuffers({good, {{"uri", "a.bin"}}}).find("buffers[1]: byteLength"),
              std::string::npos);
    EXPECT_NE(errorOfBuffers({good, {{"byteLength", 0}}}).find("buffers[1]: byteLength"),
              std::string::npos);
    EXPECT_NE(errorOfBuffers({{{"byteLength", 4}}}).find("buffers[0]: has neither"),
              std::string::npos);
}

TEST_F(ImportGltf, RefusesABinaryChunkThatIsSmallerThanItsBuffer) {
    std::string glb = Document().glb();
    const std::string announced = "\"byteLength\":60";
    const std::size_t place = glb.find("\"buffers\":[{" + announced);
    ASSERT_NE(place, std::string::npos);
    glb.replace(place + 12 + announced.size() - 2, 2, "99");
    EXPECT_NE(ImportTest::errorOf(write("a.glb", glb))
                  .find("buffers[0]: announces 99 bytes, but the binary chunk has 60"),
              std::string::npos);
}

TEST_F(ImportGltf, NamesThePrimitiveWhoseIndicesAreMissing) {
    Document document;
    document.primitive()["indices"] = 7;
    expectError(document, "meshes[0].primitives[0].indices: accessors[7] does not exist");
}

TEST_F(ImportGltf, RejectsPositionsThatAreNotFinite) {
    Document document;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    document.primitive()["attributes"]["POSITION"] =
        document.addFloats({0, 0, 0, 1, 0, 0, 1, nan, 0, 0, 1, 0}, "VEC3");
    expectError(document, "vertex 2 is not finite");
}

TEST_F(ImportGltf, RejectsNodesThatFormACycleOrHaveTwoParents) {
    Document document;
    document.root["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
    expectError(document, "nodes[0]");
    document.root["nodes"] = {{{"children", {1, 2}}}, {{"children", {2}}}, {{"mesh", 0}}};
    expectError(document, "nodes[2]");
}

TEST_F(ImportGltf, TakesAllRootNodesWhereThereIsNoScene) {
    Document document;
    document.root.erase("scenes");
    document.root.erase("scene");
    document.root["nodes"] = {{{"mesh", 0}, {"translation", {0, 0, 3}}}, {{"mesh", 0}}};
    EXPECT_EQ(import(document).triangles.size(), 4u);
}

TEST_F(ImportGltf, SurvivesTruncation) {
    const std::string glb = Document().glb();
    for (std::size_t size = 0; size < glb.size(); size += 5)
        EXPECT_FALSE(ImportTest::errorOf(write("t.glb", glb.substr(0, size))).empty()) << size;
}

TEST_F(ImportGltf, SurvivesDamagedBytes) {
    Document document;
    document.addTexture({{"bufferView", document.addView(pictureBytes(Vec3(1)))}});
    const std::string glb = document.glb();
    for (std::size_t i = 0; i < glb.size(); i += 5) {
        std::string damaged = glb;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 7)));
        try {
            ImportTest::import(write("t.glb", damaged));
        } catch (const InputError&) {
        }
    }
}

TEST_F(ImportGltf, RefusesMalformedDocuments) {
    const auto contains = [&](const std::string& text, const std::string& part) {
        EXPECT_NE(ImportTest::errorOf(write("a.gltf", text)).find(part), std::string::npos) << part;
    };
    contains("", "not a glTF file");
    contains("{\"asset\": ", "not a glTF file");
    contains("[]", "not a glTF file");
    contains("{}", "asset");
    contains(R"({"asset": {"version": "2.0"}, "nodes": {}})", "nodes: must be an array");
    contains(R"({"asset": {"version": "2.0"}, "meshes": [{"primitives": {}}]})",
             "meshes[0].primitives: must be an array");
    contains(R"({"asset": {"version": "2.0"}, "accessors": [{"count": "7"}]})",
             "accessors[0].count: must be a number");
    contains(R"({"asset": {"version": "1.0"}})", "glTF version 1.0");
    contains("{\"asset\":{\"version\":\"2.0\",\"extras\":" + std::string(100000, '['),
             "nested too deeply");
    contains(R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "none.bin"}]})",
             "none.bin");
}

TEST_F(ImportGltf, RefusesRequiredExtensionsWithAdvice) {
    Document document;
    for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                             "KHR_texture_basisu", "VENDOR_unheard_of"}) {
        document.root["extensionsRequired"] = {name};
        expectError(document, std::string(name) + " is not supported; export with");
    }
}

TEST_F(ImportGltf, AdvisesIfACompressionThatIsNotMarkedAsRequiredIsNeeded) {
    Document document;
    document.root["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    document.root["accessors"][1].erase("bufferView");
    expectError(document, "export without Draco compression");
}

TEST_F(ImportGltf, WarnsOfLightsAndOptionalExtensions) {
    Document document;
    document.root["extensionsUsed"] = {"KHR_lights_punctual", "VENDOR_unheard_of"};
    document.root["extensionsRequired"] = {"KHR_lights_punctual"};
    document.root["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}}}}}}};
    EXPECT_EQ(import(document).triangles.size(), 2u);
    EXPECT_EQ(warningsWith("1 lights of KHR_lights_punctual"), 1);
    EXPECT_EQ(warningsWith("VENDOR_unheard_of is not supported"), 1);
}

TEST_F(ImportGltf, MakesSmoothMetalsMirrors) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {0.9, 0.8, 0.7, 1}},
                                                   {"metallicFactor", 0.75},
                                                   {"roughnessFactor", 0.0}};
    const Scene scene = import(document);
    test::expectNear(scene.material(0).mirror, 0.75f * Vec3(0.9f, 0.8f, 0.7f));
    test::expectNear(scene.material(0).diffuse, 0.25f * Vec3(0.9f, 0.8f, 0.7f));
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltf, MakesRoughMetalsRoughMirrors) {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {0.9, 0.8, 0.7, 1}},
                                                   {"roughnessFactor", 0.4}};
    const Scene scene = import(document);
    test::expectNear(scene.material(0).mirror, {0.9f, 0.8f, 0.7f});
    test::expectNear(scene.material(0).diffuse, Vec3(0));
    EXPECT_FLOAT_EQ(scene.material(0).roughness, 0.16f);
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltf, MultipliesEmissionByItsStrengthOnBothSidesIfDoubleSided) {
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

TEST_F(ImportGltf, LeavesTransmissiveSurfacesOutWithAWarning) {
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

TEST_F(ImportGltf, ReadsTexturesFromFilesUrisAndBuffers) {
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

TEST_F(ImportGltf, UsesTheFactorWhereAnImageIsMissingOrDamaged) {
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

TEST_F(ImportGltf, AppliesTextureTransformsAndSamplers) {
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

TEST_F(ImportGltf, RefusesAnImageOutsideOfItsBufferThoughNobodyUsesIt) {
    Document document;
    const int view = document.addView(pictureBytes(Vec3(1)));
    document.root["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
    EXPECT_EQ(import(document).triangles.size(), 2u);
    document.root["bufferViews"][view]["byteOffset"] = 1ull << 40;
    expectError(document, "images[0]: bufferViews[2] lies outside of its buffer");
}

TEST_F(ImportGltf, LeavesOutCamerasWithoutAView) {
    Document document;
    document.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    document.root["nodes"].push_back(
        {{"camera", 0}, {"matrix", {1, 0, 0, 0, 0, 1e150, 0, 0, 0, 0, 1e-200, 0, 0, 0, 0, 1}}});
    document.root["nodes"].push_back(
        {{"camera", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1e200, 0, 0, 0, 0, 1}}});
    document.root["scenes"][0]["nodes"] = {0, 1, 2};
    EXPECT_TRUE(import(document).cameras.empty());
    EXPECT_EQ(warningsWith("cameras[0]: left out: its transform is singular"), 1);
}

TEST_F(ImportGltf, ReplacesTextureCoordinatesThatAreNotFinite) {
    Document document;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    document.primitive()["attributes"]["TEXCOORD_0"] =
        document.addFloats({nan, 0, 1, 0, 1, nan, 0, 1}, "VEC2");
    for (const Vec2& uv : import(document).uvs) EXPECT_TRUE(isFinite(Vec3(uv, 0)));
    EXPECT_EQ(warningsWith("texture coordinates: those that are not finite"), 1);
}

TEST_F(ImportGltf, TakesAnAbsurdSetOfTextureCoordinatesAsTheFirst) {
    Document document;
    document.addTexture({{"uri", "gone.png"}});
    document.material()["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        {"KHR_texture_transform", {{"texCoord", 1e300}, {"offset", {0.5, 0}}}}};
    EXPECT_EQ(maxComponent(Vec3(boundsOfUvs(import(document)), 0)), 1.5f);
}

TEST_F(ImportGltf, RefusesMoreVerticesThanFit) {
    Document document;
    const int many = document.addAccessor({}, 5126, 16384, "VEC3");
    document.root["accessors"][many].erase("bufferView");
    json primitive = document.primitive();
    primitive["attributes"]["POSITION"] = many;
    for (int i = 0; i < 6400; ++i) document.root["meshes"][0]["primitives"].push_back(primitive);
    expectError(document, "triangles; at most");
}

TEST_F(ImportGltf, RefusesMoreTrianglesThanFit) {
    Document document;
    std::vector<std::uint16_t> indices(60000);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = i % 3;
    document.primitive()["indices"] = document.addIndices(indices);
    for (int i = 1; i < 3000; ++i) {
        document.root["nodes"].push_back({{"mesh", 0}});
        document.root["scenes"][0]["nodes"].push_back(i);
    }
    expectError(document, "triangles; at most");
}

}  // namespace
}  // namespace vlf
