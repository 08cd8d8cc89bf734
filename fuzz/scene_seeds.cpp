#include "fuzz/scratch.h"
#include "fuzz/seeds.h"

#include "vlf/base/file.h"
#include "vlf/image/image_io.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <limits>
#include <string>

namespace vlf::fuzz {

namespace {

using nlohmann::json;

const std::string kObj = R"(# every statement
mtllib library.mtl
o box
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0.5 0.5 0.5 0.5
v .4 .4 -1e-2
vt 0 0
vt 1 0 0
vt 1
vn 0 0 1
vn 0 0.1 2
usemtl a
s 1
f 1/1/1 2/2/1 3/3/2
f -5 -4 -3 -2
g side
usemtl wild name
s off
f 1//1 5//2 4//1 \
  3
fo 1 3 5
l 1 2
usemtl b
f 5 3 1
)";

const std::string kLibrary = R"(newmtl a
Kd 0.5 0.4 0.3
map_Kd -s 2 2 -o 0.5 0.25 texture.png
newmtl b
Ke 5
map_Ke -clamp on texture.hdr
newmtl wild name
Kd 1 1 1
map_Kd wild.exr
)";

const std::string kMtl = R"(# every statement
newmtl a
Ka 0 0 0
Kd 0.5 0.25 0.1
Ks 0.3 0.3 0.3
Ns 20
d 1.0
illum 2
map_Kd -s 2 3 1 -o 0.5 0.5 0 -clamp on -bm 1 texture.png
newmtl b
Kd 0.2
Ks 0.7
Pr 0.01
Tr 0
Ke 4 3 2
map_Ks texture.png
map_Ke texture.hdr
newmtl c
d -halo 0.7
illum 3
Ks 0.9 0.9 0.9
Kd 0.3 0.3 0.3
map_Kd wild.exr
map_d texture.png
)";

const std::string kCameras = R"({"cameras": [
  {"name": "front", "eye": [0, 1.5, 4], "look": [0, 1, 0], "up": [0, 1, 0], "verticalFov": 60},
  {"name": "side", "eye": [3, 1, 0], "look": [0, 1, 0]}]})";

const std::string kTriangleBase64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

std::string textureFile(const std::string& name, const Image& image) {
    writePng(scratchPath(name), image);
    const Blob bytes = readFile(scratchPath(name));
    return {bytes.begin(), bytes.end()};
}

Image smallPicture() {
    Image image(3, 2, Vec3(0.5f));
    image.at(1, 0) = {1, 0.25f, 0};
    return image;
}

/// Three pixels in runs of encoded components would be shorter than their marks: plain ones.
Blob hdrFile() {
    Blob bytes = toBlob("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n");
    for (const std::uint8_t byte : {128, 64, 32, 130, 255, 255, 255, 120}) bytes.push_back(byte);
    return bytes;
}

template <class T>
std::string bytesOf(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// The binary chunk of a GLB file and what describes it.
class Buffer {
  public:
    int addView(const std::string& bytes) {
        views_.push_back(
            {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
        bytes_ += bytes;
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
        return static_cast<int>(views_.size()) - 1;
    }
    template <class T>
    int add(const std::vector<T>& values, int componentType, const char* type, int components) {
        accessors_.push_back({{"bufferView", addView(bytesOf(values))},
                              {"componentType", componentType},
                              {"count", values.size() / components},
                              {"type", type}});
        return static_cast<int>(accessors_.size()) - 1;
    }
    json& accessor(int i) { return accessors_[i]; }

    void describe(json& root) const {
        root["bufferViews"] = views_;
        root["accessors"] = accessors_;
        root["buffers"] = {{{"byteLength", bytes_.size()}}};
    }
    const std::string& bytes() const { return bytes_; }

  private:
    json views_ = json::array(), accessors_ = json::array();
    std::string bytes_;
};

constexpr int kFloat = 5126, kUnsignedShort = 5123;

/// A square of two triangles with all that the importer reads.
json document(Buffer& buffer) {
    using Floats = std::vector<float>;
    using Shorts = std::vector<std::uint16_t>;
    const int positions = buffer.add(Floats{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, kFloat, "VEC3", 3);
    const int normals = buffer.add(Floats{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3", 3);
    const int uvs = buffer.add(Floats{0, 1, 1, 1, 1, 0, 0, 0}, kFloat, "VEC2", 2);
    const int list = buffer.add(Shorts{0, 1, 2, 0, 2, 3}, kUnsignedShort, "SCALAR", 1);
    const int strip = buffer.add(Shorts{0, 1, 3, 2}, kUnsignedShort, "SCALAR", 1);
    const int where = buffer.addView(bytesOf(Shorts{3}));
    const int what = buffer.addView(bytesOf(Floats{0, 1, 0.5f}));
    buffer.accessor(positions)["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", where}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", what}}}};
    const int picture = buffer.addView(textureFile("inside.png", smallPicture()));

    json root{{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0, 2}}}}}};
    root["nodes"] = {
        {{"children", {1}}, {"translation", {1, 2, 3}}, {"rotation", {0, 0.6, 0, 0.8}}},
        {{"mesh", 0}, {"scale", {-1, 2, 1}}},
        {{"camera", 0}, {"mesh", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}}};
    root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
    root["meshes"] = {
        {{"name", "square"},
         {"primitives",
          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
            {"indices", list},
            {"material", 0}}}}},
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}}},
            {"indices", strip},
            {"mode", 5},
            {"material", 1}},
           {{"attributes", {{"POSITION", positions}}}, {"mode", 6}}}}}};
    root["materials"] = {
        {{"name", "paint"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.4, 0.3, 1}},
           {"metallicFactor", 0.2},
           {"roughnessFactor", 0.01},
           {"metallicRoughnessTexture", {{"index", 0}}},
           {"baseColorTexture",
            {{"index", 0},
             {"extensions",
              {{"KHR_texture_transform",
                {{"offset", {0.1, 0.2}}, {"rotation", 1}, {"scale", {2, 3}}}}}}}}}}},
        {{"emissiveFactor", {1, 1, 0.5}},
         {"emissiveTexture", {{"index", 1}}},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 7}}},
           {"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.1, 0.2, 0.3, 1}}}}}}}};
    root["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
    root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    root["images"] = {{{"bufferView", picture}, {"mimeType", "image/png"}},
                      {{"uri", "texture.png"}}};
    root["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_emissive_strength",
                              "KHR_lights_punctual"};
    root["extensions"] = {{"KHR_lights_punctual",
                           {{"lights",
                             {{{"type", "spot"},
                               {"color", {1, 0.5, 0}},
                               {"intensity", 30},
                               {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
                              {{"type", "directional"}, {"range", 4}}}}}}};
    root["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
    root["nodes"][2]["extensions"] = {{"KHR_lights_punctual", {{"light", 1}}}};
    buffer.describe(root);
    return root;
}

Blob glb(const json& root, const std::string& binary) {
    std::string text = root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto u32 = [](std::size_t n) {
        return bytesOf(std::vector<std::uint32_t>{static_cast<std::uint32_t>(n)});
    };
    return toBlob("glTF" + u32(2) + u32(28 + text.size() + binary.size()) + u32(text.size()) +
                  "JSON" + text + u32(binary.size()) + std::string("BIN\0", 4) + binary);
}

/// The buffer that text documents name.
Buffer sharedBuffer() {
    Buffer buffer;
    document(buffer);
    return buffer;
}

}  // namespace

std::vector<Blob> objSeeds() {
    return {toBlob(kObj), toBlob("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")};
}

std::vector<Blob> mtlSeeds() {
    return {toBlob(kMtl), toBlob(kLibrary)};
}

std::vector<Blob> cameraSeeds() {
    return {toBlob(kCameras)};
}

std::vector<Blob> gltfSeeds() {
    Buffer buffer;
    json root = document(buffer);
    const Blob binary = glb(root, buffer.bytes());
    root["buffers"][0]["uri"] = "buffer.bin";
    const json small{
        {"asset", {{"version", "2.0"}}},
        {"nodes", {{{"mesh", 0}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
        {"accessors",
         {{{"bufferView", 0}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}}}},
        {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
        {"buffers",
         {{{"byteLength", 36},
           {"uri", "data:application/octet-stream;base64," + kTriangleBase64}}}}};
    return {binary, toBlob(root.dump()), toBlob(small.dump())};
}

Blob objOfMaterials() {
    return toBlob(
        "mtllib input.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
        "vt 0 0\nvt 2 0\nvt 1e30 3\n"
        "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/2 4/3\nusemtl c\nf 1/3 2/2 5/1\n");
}

void putSceneFiles() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    putFile("library.mtl", toBlob(kLibrary));
    putFile("input.cameras.json", toBlob(kCameras));
    textureFile("texture.png", smallPicture());
    putFile("texture.hdr", hdrFile());
    Image wild(2, 2, Vec3(0.5f));
    wild.at(0, 0) = {-1, kInfinity, std::numeric_limits<float>::quiet_NaN()};
    writeExr(scratchPath("wild.exr"), wild);
    putFile("buffer.bin", toBlob(sharedBuffer().bytes()));
}

}  // namespace vlf::fuzz
