#include "unit/scene/gltf_document.h"

namespace vlf {
namespace {

using nlohmann::json;
using test::Document;

class ImportDamagedGltf : public test::GltfTest {};

TEST_F(ImportDamagedGltf, RejectsReferencesAndDataOutOfBounds) {
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

TEST_F(ImportDamagedGltf, NamesTheBufferThatIsAtFault) {
    const auto errorOfBuffers = [&](const json& buffers) {
        json root = Document().root;
        root["buffers"] = buffers;
        return ImportTest::errorOf(write("a.gltf", root.dump()));
    };
    const json good = {{"byteLength", 4}, {"uri", "data:application/octet-stream;base64,AAAAAA=="}};
    EXPECT_NE(errorOfBuffers({good, {{"uri", "a.bin"}}}).find("buffers[1]: byteLength"),
              std::string::npos);
    EXPECT_NE(errorOfBuffers({good, {{"byteLength", 0}}}).find("buffers[1]: byteLength"),
              std::string::npos);
    EXPECT_NE(errorOfBuffers({{{"byteLength", 4}}}).find("buffers[0]: has neither"),
              std::string::npos);
}

TEST_F(ImportDamagedGltf, RefusesABinaryChunkThatIsSmallerThanItsBuffer) {
    std::string glb = Document().glb();
    const std::string announced = "\"byteLength\":60";
    const std::size_t place = glb.find("\"buffers\":[{" + announced);
    ASSERT_NE(place, std::string::npos);
    glb.replace(place + 12 + announced.size() - 2, 2, "99");
    EXPECT_NE(ImportTest::errorOf(write("a.glb", glb))
                  .find("buffers[0]: announces 99 bytes, but the binary chunk has 60"),
              std::string::npos);
}

TEST_F(ImportDamagedGltf, NamesThePrimitiveWhoseIndicesAreMissing) {
    Document document;
    document.primitive()["indices"] = 7;
    expectError(document, "meshes[0].primitives[0].indices: accessors[7] does not exist");
}

TEST_F(ImportDamagedGltf, RejectsPositionsThatAreNotFinite) {
    Document document;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    document.primitive()["attributes"]["POSITION"] =
        document.addFloats({0, 0, 0, 1, 0, 0, 1, nan, 0, 0, 1, 0}, "VEC3");
    expectError(document, "vertex 2 is not finite");
}

TEST_F(ImportDamagedGltf, RejectsNodesThatFormACycleOrHaveTwoParents) {
    Document document;
    document.root["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
    expectError(document, "nodes[0]");
    document.root["nodes"] = {{{"children", {1, 2}}}, {{"children", {2}}}, {{"mesh", 0}}};
    expectError(document, "nodes[2]");
}

TEST_F(ImportDamagedGltf, SurvivesTruncation) {
    const std::string glb = Document().glb();
    for (std::size_t size = 0; size < glb.size(); size += 5)
        EXPECT_FALSE(ImportTest::errorOf(write("t.glb", glb.substr(0, size))).empty()) << size;
}

TEST_F(ImportDamagedGltf, SurvivesDamagedBytes) {
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

TEST_F(ImportDamagedGltf, RefusesMalformedDocuments) {
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
             "accessors[0].count: must be a whole number");
    contains(R"({"asset": {"version": "1.0"}})", "glTF version 1.0");
    contains("{\"asset\":{\"version\":\"2.0\",\"extras\":" + std::string(100000, '['),
             "nested too deeply");
    contains(R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "none.bin"}]})",
             "none.bin");
}

TEST_F(ImportDamagedGltf, RefusesRequiredExtensionsThatItDoesNotKnow) {
    Document document;
    for (const char* name : {"EXT_mesh_gpu_instancing", "VENDOR_unheard_of"}) {
        document.root["extensionsRequired"] = {name};
        expectError(document, std::string(name) + " is not supported; export without it");
    }
}

TEST_F(ImportDamagedGltf, NamesTheElementThatRefersToNothing) {
    const auto expectMissing = [&](const char* pointer, const json& value,
                                   const std::string& message) {
        Document document;
        document.addTexture({{"uri", "a.png"}});
        document.root[json::json_pointer(pointer)] = value;
        expectError(document, message);
    };
    expectMissing("/scene", 2, "scene: scenes[2] does not exist");
    expectMissing("/scenes/0/nodes", {0, 4}, "scenes[0].nodes[1]: nodes[4] does not exist");
    expectMissing("/nodes/0/children", {-1}, "nodes[0].children[0]: nodes[-1] does not exist");
    expectMissing("/nodes/0/camera", 0, "nodes[0].camera: cameras[0] does not exist");
    expectMissing("/meshes/0/primitives/0/attributes/COLOR_0", "x",
                  "meshes[0].primitives[0].attributes.COLOR_0: accessors[\"x\"] does not exist");
    expectMissing("/meshes/0/primitives/0/targets", {{{"NORMAL", 9}}},
                  "meshes[0].primitives[0].targets[0].NORMAL: accessors[9] does not exist");
    expectMissing("/skins", {{{"inverseBindMatrices", 8}}},
                  "skins[0].inverseBindMatrices: accessors[8] does not exist");
    expectMissing("/textures/0/source", 1, "textures[0].source: images[1] does not exist");
    expectMissing("/textures/0/sampler", 0, "textures[0].sampler: samplers[0] does not exist");
    expectMissing("/images/0/bufferView", 50, "images[0].bufferView: bufferViews[50]");
    expectMissing("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 3,
                  "materials[0].pbrMetallicRoughness.baseColorTexture: textures[3] does not exist");
    expectMissing("/materials/0/normalTexture", json::object(),
                  "materials[0].normalTexture: has no index of a texture");
    expectMissing("/materials/0/extensions/VENDOR_coat/coatTexture/index", 1.5,
                  "materials[0].extensions.VENDOR_coat.coatTexture: textures[1.5] does not exist");
    expectMissing("/textures/0", {{"extensions", {{"EXT_texture_webp", {{"source", 9}}}}}},
                  "images[9] does not exist");
}

TEST_F(ImportDamagedGltf, NamesThePropertyOfTheWrongType) {
    const auto expectWrong = [&](const char* pointer, const json& value,
                                 const std::string& message) {
        Document document;
        document.root[json::json_pointer(pointer)] = value;
        expectError(document, message);
    };
    expectWrong("/nodes/0/scale", {1, "1", 1}, "nodes[0].scale: must be an array of numbers");
    expectWrong("/nodes/0/weights", 1, "nodes[0].weights: must be an array of numbers");
    expectWrong("/accessors/0/normalized", 1, "accessors[0].normalized: must be true or false");
    expectWrong("/accessors/0/count", 2.5, "accessors[0].count: must be a whole number");
    expectWrong("/bufferViews/0/byteOffset", -4,
                "bufferViews[0].byteOffset: must be a whole number");
    expectWrong("/images", {{{"uri", 7}}}, "images[0].uri: must be a string");
    expectWrong("/meshes/0/primitives/0/mode", "strip",
                "meshes[0].primitives[0].mode: must be a whole number");
    expectWrong("/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0]: mode 7 does not exist");
}

TEST_F(ImportDamagedGltf, NamesTheBufferWhoseUriIsAtFault) {
    const auto expectFault = [&](const std::string& uri, const std::string& message) {
        Document document;
        document.moreBuffers = {{{"byteLength", 4}, {"uri", uri}}};
        expectError(document, message);
    };
    expectFault("data:application/octet-stream;base64,AA?A",
                "buffers[1]: the data URI is not valid");
    expectFault("data:application/octet-stream,AAAA", "buffers[1]: the data URI is not in base64");
    expectFault("data:;base64,AAAA", "buffers[1]: announces 4 bytes, but its uri has 3");
    expectFault("gone%20away.bin", "gone away.bin: no such file");
    expectFault("http://example.com/a.bin", "a.bin: no such file");
}

TEST_F(ImportDamagedGltf, SaysWhatIsWrongWithTheChunksOfAGlb) {
    const auto expectFault = [&](const std::string& glb, const std::string& message) {
        const std::string error = ImportTest::errorOf(write("a.glb", glb));
        EXPECT_NE(error.find("a.glb: " + message), std::string::npos) << error;
    };
    const std::string glb = Document().glb();
    const auto with = [&](std::size_t place, const std::string& bytes) {
        return std::string(glb).replace(place, bytes.size(), bytes);
    };
    expectFault(with(4, "\x01"), "GLB version 1 is not supported");
    expectFault(with(16, "BIN"), "the first chunk of a GLB file must be JSON");
    expectFault(with(14, "\xff"), "truncated GLB file: a chunk ends after the file");
    expectFault(with(8, std::string("\x0c\0\0", 3)), "a GLB file without a chunk");
    expectFault(glb.substr(0, 10), "truncated GLB header");
    expectFault(glb.substr(0, glb.size() - 1), "truncated GLB file");
}

TEST_F(ImportDamagedGltf, RefusesMoreTrianglesThanFit) {
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

TEST_F(ImportDamagedGltf, LeavesOutCamerasWithoutAView) {
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

TEST_F(ImportDamagedGltf, RefusesMoreVerticesThanFit) {
    Document document;
    const int many = document.addAccessor({}, 5126, 16384, "VEC3");
    document.root["accessors"][many].erase("bufferView");
    nlohmann::json primitive = document.primitive();
    primitive["attributes"]["POSITION"] = many;
    for (int i = 0; i < 6400; ++i) document.root["meshes"][0]["primitives"].push_back(primitive);
    expectError(document, "triangles; at most");
}

}  // namespace
}  // namespace vlf
