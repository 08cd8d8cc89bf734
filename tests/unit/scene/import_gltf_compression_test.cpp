// Compressed geometry and pictures. The tests compress by the libraries that the importer reads by.

#include "unit/scene/gltf_document.h"

#include <meshoptimizer.h>
#include <webp/encode.h>

namespace vlf {
namespace {

using nlohmann::json;
using test::Document;

class ImportCompressedGltf : public test::GltfTest {
  protected:
    void expectSquare(const Document& document) {
        const Scene scene = import(document);
        ASSERT_EQ(scene.triangles.size(), 2u);
        EXPECT_NEAR(test::totalArea(scene), 1, 1e-4);
        test::expectNear(boundsOf(scene).upper, {1, 1, 0}, 1e-4f);
        for (std::uint32_t t = 0; t < 2; ++t)
            test::expectNear(geometricNormal(scene, t), {0, 0, 1});
        EXPECT_TRUE(report_.warnings.empty());
    }
};

Document plainSquare() {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    return document;
}

const std::vector<float> kCorners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

std::string meshoptVertices(const void* vertices, std::size_t count, std::size_t stride) {
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                            bytes.size(), vertices, count, stride));
    return bytes;
}

std::string meshoptTriangles(const std::vector<unsigned>& indices) {
    std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), 4), '\0');
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                           bytes.size(), indices.data(), indices.size()));
    return bytes;
}

std::string meshoptSequence(const std::vector<unsigned>& indices) {
    std::string bytes(meshopt_encodeIndexSequenceBound(indices.size(), 4), '\0');
    bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()),
                                             bytes.size(), indices.data(), indices.size()));
    return bytes;
}

/// Puts compressed bytes in place of a view; what it held before is in a buffer without data.
json& compressView(Document& document, std::size_t view, const std::string& bytes,
                   std::size_t count, std::size_t stride, const std::string& mode) {
    const int source = document.addView(bytes);
    json& views = document.root["bufferViews"];
    json extension = views[static_cast<std::size_t>(source)];
    extension.update({{"count", count}, {"byteStride", stride}, {"mode", mode}});
    views[view] = {{"buffer", 1},
                   {"byteLength", count * stride},
                   {"extensions", {{"EXT_meshopt_compression", extension}}}};
    return views[view]["extensions"]["EXT_meshopt_compression"];
}

/// The square with positions and indices compressed.
Document meshoptSquare() {
    Document document = plainSquare();
    compressView(document, 0, meshoptVertices(kCorners.data(), 4, 12), 4, 12, "ATTRIBUTES");
    compressView(document, 1, meshoptTriangles({0, 1, 2, 0, 2, 3}), 6, 2, "TRIANGLES");
    document.moreBuffers.push_back(
        {{"byteLength", 100}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    document.root["extensionsUsed"] =
        document.root["extensionsRequired"] = {"EXT_meshopt_compression"};
    return document;
}

TEST_F(ImportCompressedGltf, DecodesMeshopt) {
    expectSquare(meshoptSquare());
    Document document = meshoptSquare();
    document.primitive()["mode"] = 5;
    compressView(document, 1, meshoptSequence({0, 1, 3, 2}), 4, 2, "INDICES");
    document.root["accessors"][1]["count"] = 4;
    expectSquare(document);
}

TEST_F(ImportCompressedGltf, AppliesMeshoptFilters) {
    Document document = meshoptSquare();
    std::vector<std::uint32_t> exponents(12);
    meshopt_encodeFilterExp(exponents.data(), 4, 12, 20, kCorners.data());
    compressView(document, 0, meshoptVertices(exponents.data(), 4, 12), 4, 12,
                 "ATTRIBUTES")["filter"] = "EXPONENTIAL";
    expectSquare(document);

    const float tilted[] = {0.6f, 0, 0.8f, 0};
    std::vector<std::int8_t> normals(16);
    for (std::size_t i = 0; i < 4; ++i) meshopt_encodeFilterOct(&normals[4 * i], 1, 4, 8, tilted);
    const int accessor = document.addAccessor(std::string(16, '\0'), 5120, 4, "VEC3");
    document.root["accessors"][accessor]["normalized"] = true;
    const auto view = document.root["accessors"][accessor]["bufferView"].get<std::size_t>();
    compressView(document, view, meshoptVertices(normals.data(), 4, 4), 4, 4,
                 "ATTRIBUTES")["filter"] = "OCTAHEDRAL";
    document.root["bufferViews"][view]["byteStride"] = 4;
    document.primitive()["attributes"]["NORMAL"] = accessor;
    test::expectNear(import(document).normals[0], {0.6f, 0, 0.8f}, 0.02f);
}

TEST_F(ImportCompressedGltf, NamesTheViewOfMeshoptThatIsDamaged) {
    const auto expectDamage = [&](const char* property, const json& value, const char* message) {
        Document document = meshoptSquare();
        document.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][property] = value;
        expectError(document, std::string("bufferViews[0]: ") + message);
    };
    expectDamage("mode", "POINTS", "mode 'POINTS' does not exist");
    expectDamage("filter", "BLUR", "filter 'BLUR' does not exist");
    expectDamage("filter", "QUATERNION", "filter 'QUATERNION' does not exist or does not fit");
    expectDamage("byteStride", 13, "count or byteStride do not fit");
    expectDamage("count", 1ull << 40, "count or byteStride do not fit");
    expectDamage("count", "4", "count must be a whole number");
    expectDamage("buffer", 9, "buffers[9] does not exist");
    expectDamage("byteLength", 1ull << 40, "the compressed data lie outside");
    expectDamage("byteLength", 9, "the compressed data are damaged");
    Document document = meshoptSquare();
    document.root["bufferViews"][0].erase("extensions");
    expectError(document, "bufferViews[0] lies outside of its buffer of 0 bytes");
}

TEST_F(ImportCompressedGltf, NamesThePrimitiveThatExistsInDracoAlone) {
    Document document = plainSquare();
    document.primitive()["extensions"] = {
        {"KHR_draco_mesh_compression", {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}}}};
    document.root["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    EXPECT_EQ(import(document).triangles.size(), 2u) << "it is there uncompressed, too";
    EXPECT_EQ(warningsWith("KHR_draco_mesh_compression is not supported"), 1);
    for (const int accessor : {0, 1}) {
        Document alone = document;
        alone.root["accessors"][accessor].erase("bufferView");
        expectError(alone,
                    "meshes[0].primitives[0]: compressed by KHR_draco_mesh_compression, which is "
                    "not decoded; export without Draco");
    }
}

TEST_F(ImportCompressedGltf, SurvivesDamagedBytes) {
    const std::string whole = meshoptSquare().gltf();
    const std::size_t begin = whole.find(";base64,") + 8, end = whole.find('"', begin);
    for (std::size_t i = begin; i < end; ++i) {
        std::string damaged = whole;
        damaged[i] = damaged[i] == 'A' ? 'z' : 'A';
        try {
            ImportTest::import(write("a.gltf", damaged));
        } catch (const InputError&) {
        }
    }
}

std::string webp(const std::array<std::uint8_t, 3>& colour) {
    std::uint8_t* encoded = nullptr;
    const std::size_t size = WebPEncodeLosslessRGB(colour.data(), 1, 1, 3, &encoded);
    std::string bytes(reinterpret_cast<char*>(encoded), size);
    WebPFree(encoded);
    return bytes;
}

TEST_F(ImportCompressedGltf, ReadsTexturesInWebpUnlessThereIsAnother) {
    Document document;
    document.addTexture({{"bufferView", document.addView(webp({255, 0, 0}))}});
    document.root["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    document.root["extensionsRequired"] = {"EXT_texture_webp"};
    Scene scene = import(document);
    test::expectNear(diffuseReflectance(scene, scene.material(0), Vec2(0)), {1, 0, 0});
    EXPECT_TRUE(report_.warnings.empty());

    const std::string green = pictureBytes(Vec3(0, 1, 0));
    document.root["images"].push_back({{"bufferView", document.addView(green)}});
    document.root["textures"][0]["source"] = 1;
    scene = import(document);
    test::expectNear(diffuseReflectance(scene, scene.material(0), Vec2(0.25f, 0.75f)), {0, 1, 0});
}

TEST_F(ImportCompressedGltf, UsesTheFactorWhereAPictureInWebpIsDamaged) {
    const std::string whole = webp({255, 0, 0});
    for (const std::size_t size : {std::size_t{13}, whole.size() - 3}) {
        report_ = {};
        Document document;
        document.addTexture({{"bufferView", document.addView(whole.substr(0, size))}});
        EXPECT_EQ(import(document).material(0).diffuseTexture, -1);
        EXPECT_EQ(warningsWith("damaged image"), 1) << size;
    }
}

TEST_F(ImportCompressedGltf, UsesTheFactorForPicturesInKtx) {
    Document document;
    document.addTexture({{"bufferView", document.addView("\xabKTX 20\xbb\r\n\x1a\n and so on")}});
    document.root["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    document.root["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_EQ(import(document).material(0).diffuseTexture, -1);
    EXPECT_EQ(warningsWith("images[0] '': KTX2 is not decoded, export PNG or JPEG; its factor "
                           "alone is used"),
              1);
}

}  // namespace
}  // namespace vlf
