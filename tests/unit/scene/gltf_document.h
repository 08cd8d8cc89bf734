#pragma once
// glTF documents for the import tests.

#include "unit/scene/import_support.h"
#include "vlf/image/image_io.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace vlf::test {

using nlohmann::json;

inline std::string base64(const std::string& bytes) {
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
        const std::map<std::string, std::size_t> sizes{
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
        const std::size_t components = sizes.at(type);
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
        for (const json& buffer : moreBuffers) all["buffers"].push_back(buffer);
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
    json moreBuffers = json::array();

  private:
    std::string buffer_;
};

/// Imports documents.
class GltfTest : public ImportTest {
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

}  // namespace vlf::test
