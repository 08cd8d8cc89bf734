#include "vlf/scene/import/gltf_json.h"

#include "vlf/scene/import/warn.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace vlf {

namespace {

using nlohmann::json;

constexpr int kMaxJsonDepth = 200;
constexpr std::size_t kMaxJsonBytes = std::size_t{1} << 30;

const std::set<std::string> kSupported = {"KHR_materials_emissive_strength",
                                          "KHR_materials_pbrSpecularGlossiness",
                                          "KHR_texture_transform", "KHR_mesh_quantization"};

/// Extensions without which a scene can still be shown, even if they are required.
bool isDispensable(const std::string& extension) {
    return extension.starts_with("KHR_materials_") || extension == "KHR_lights_punctual" ||
           extension == "KHR_xmp_json_ld";
}

/// Extensions that files are commonly compressed with, and what to do.
const std::map<std::string, std::string> kCompressions = {
    {"KHR_draco_mesh_compression", "export without Draco compression"},
    {"EXT_meshopt_compression", "export without meshopt compression"},
    {"KHR_texture_basisu", "export with PNG or JPEG textures"},
    {"EXT_texture_webp", "export with PNG or JPEG textures"}};

std::string adviceFor(const std::string& extension) {
    const auto found = kCompressions.find(extension);
    return fmt::format("{} is not supported; {}", extension,
                       found == kCompressions.end() ? "export without it" : found->second);
}

/// Properties of the elements of a collection and the type they must have if they are there.
struct Property {
    const char *collection, *name;
    bool (json::*hasType)() const noexcept;
    const char* type;
};
constexpr auto kArray = &json::is_array;
constexpr auto kObject = &json::is_object;
constexpr auto kNumber = &json::is_number;
constexpr Property kProperties[] = {
    {"scenes", "nodes", kArray, "an array"},
    {"nodes", "children", kArray, "an array"},
    {"nodes", "matrix", kArray, "an array"},
    {"nodes", "translation", kArray, "an array"},
    {"nodes", "rotation", kArray, "an array"},
    {"nodes", "scale", kArray, "an array"},
    {"nodes", "mesh", kNumber, "a number"},
    {"nodes", "camera", kNumber, "a number"},
    {"meshes", "primitives", kArray, "an array"},
    {"primitives", "attributes", kObject, "an object"},
    {"primitives", "indices", kNumber, "a number"},
    {"primitives", "material", kNumber, "a number"},
    {"primitives", "mode", kNumber, "a number"},
    {"accessors", "bufferView", kNumber, "a number"},
    {"accessors", "byteOffset", kNumber, "a number"},
    {"accessors", "count", kNumber, "a number"},
    {"accessors", "sparse", kObject, "an object"},
    {"bufferViews", "buffer", kNumber, "a number"},
    {"bufferViews", "byteOffset", kNumber, "a number"},
    {"bufferViews", "byteLength", kNumber, "a number"},
    {"bufferViews", "byteStride", kNumber, "a number"},
    {"materials", "pbrMetallicRoughness", kObject, "an object"},
    {"materials", "emissiveFactor", kArray, "an array"},
    {"textures", "source", kNumber, "a number"},
};

void checkElement(const std::string& path, const json& value, const std::string& collection,
                  const std::string& element) {
    if (!value.is_object()) throw InputError({path, 0, element}, "must be an object");
    for (const Property& property : kProperties) {
        if (property.collection != collection) continue;
        const auto found = value.find(property.name);
        if (found != value.end() && !((*found).*property.hasType)())
            throw InputError({path, 0, fmt::format("{}.{}", element, property.name)},
                             fmt::format("must be {}", property.type));
    }
}

/// A collection whose type has been checked; empty if it is not there.
const json& elements(const json& parent, const char* collection) {
    static const json kNone = json::array();
    const auto found = parent.find(collection);
    return found == parent.end() ? kNone : *found;
}

void checkCollection(const std::string& path, const json& parent, const std::string& name,
                     const std::string& prefix) {
    const auto found = parent.find(name);
    if (found == parent.end()) return;
    if (!found->is_array()) throw InputError({path, 0, prefix + name}, "must be an array");
    for (std::size_t i = 0; i < found->size(); ++i)
        checkElement(path, (*found)[i], name, fmt::format("{}{}[{}]", prefix, name, i));
}

void checkTypes(const std::string& path, const json& root) {
    for (const char* name : {"scenes", "nodes", "meshes", "cameras", "accessors", "bufferViews",
                             "buffers", "materials", "textures", "images", "samplers"})
        checkCollection(path, root, name, "");
    const json& meshes = elements(root, "meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i)
        checkCollection(path, meshes[i], "primitives", fmt::format("meshes[{}].", i));
}

void checkIndices(const std::string& path, const json& primitive, std::size_t accessors,
                  const std::string& element) {
    const auto found = primitive.find("indices");
    if (found != primitive.end() && !(*found >= 0 && *found < accessors))
        throw InputError({path, 0, element + ".indices"},
                         fmt::format("accessors[{}] does not exist", found->dump()));
}

void checkAllIndices(const std::string& path, const json& root) {
    const std::size_t accessors = elements(root, "accessors").size();
    const json& meshes = elements(root, "meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const json& primitives = elements(meshes[m], "primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p)
            checkIndices(path, primitives[p], accessors,
                         fmt::format("meshes[{}].primitives[{}]", m, p));
    }
}

/// A number of an element that exists, else of nothing; 0 if it is not there.
json numberOf(const json& elements, const json& index, const char* name) {
    if (!index.is_number_unsigned() || index >= elements.size()) return 0;
    return elements[index.get<std::size_t>()].value(name, json(0));
}

/// tinygltf takes the address of an image in a buffer view before anybody looks where it is.
void checkImageViews(const std::string& path, const json& root) {
    const json &views = elements(root, "bufferViews"), &images = elements(root, "images");
    for (std::size_t i = 0; i < images.size(); ++i) {
        const json view = images[i].value("bufferView", json());
        const json offset = numberOf(views, view, "byteOffset");
        const json buffer = numberOf(views, view, "buffer");
        if (!(offset >= 0) || offset > numberOf(elements(root, "buffers"), buffer, "byteLength"))
            throw InputError(
                {path, 0, fmt::format("images[{}]", i)},
                fmt::format("bufferViews[{}] lies outside of its buffer", view.dump()));
    }
}

void checkVersion(const std::string& path, const json& root) {
    const SourceLocation where{path, 0, "asset"};
    if (!root.contains("asset") || !root["asset"].is_object())
        throw InputError(where, "missing; this is not a glTF 2.0 file");
    const json version = root["asset"].value("version", json("1.0"));
    if (!version.is_string()) throw InputError(where, "the version must be a string");
    if (!version.get<std::string>().starts_with("2."))
        throw InputError(where, fmt::format("glTF version {} is not supported; convert to 2.0",
                                            version.get<std::string>()));
}

std::vector<std::string> names(const std::string& path, const json& root, const char* property) {
    const auto found = root.find(property);
    if (found == root.end()) return {};
    const SourceLocation where{path, 0, property};
    if (!found->is_array()) throw InputError(where, "must be an array");
    std::vector<std::string> result;
    for (const json& name : *found) {
        if (!name.is_string()) throw InputError(where, "must hold strings");
        result.push_back(name.get<std::string>());
    }
    return result;
}

std::string checkExtensions(const std::string& path, const json& root, ImportReport& report) {
    for (const std::string& name : names(path, root, "extensionsRequired"))
        if (!kSupported.contains(name) && !isDispensable(name))
            throw InputError({path, 0, "extensionsRequired"}, adviceFor(name));
    std::string advice;
    for (const std::string& name : names(path, root, "extensionsUsed")) {
        if (!kSupported.contains(name) && name != "KHR_lights_punctual")
            warn(report, {path, 0, "extensionsUsed"}, name + " is not supported and left out");
        if (kCompressions.contains(name)) advice = adviceFor(name);
    }
    return advice;
}

void checkBuffer(const SourceLocation& where, const json& buffer, bool mayBeBinaryChunk,
                 std::size_t binaryBytes) {
    const json length = buffer.value("byteLength", json());
    if (!length.is_number() || length <= 0)
        throw InputError(where, "byteLength must be a number above 0");
    if (buffer.contains("uri")) return;
    if (!mayBeBinaryChunk || binaryBytes == 0)
        throw InputError(where, "has neither a uri nor the binary chunk of a GLB file");
    if (length > binaryBytes)
        throw InputError(where, fmt::format("announces {} bytes, but the binary chunk has {}",
                                            length.dump(), binaryBytes));
}

void checkBuffers(const std::string& path, const json& root, std::size_t binaryBytes) {
    const json& buffers = elements(root, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i)
        checkBuffer({path, 0, fmt::format("buffers[{}]", i)}, buffers[i], i == 0, binaryBytes);
}

void checkSize(const std::string& path, std::string_view text) {
    if (text.size() > kMaxJsonBytes)
        throw InputError({path, 0, ""}, "more than 1 GiB of JSON; keep the buffers in a .bin file");
    int depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') ++i;
            inString = c != '"';
        } else if (c == '"') {
            inString = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kMaxJsonDepth) throw InputError({path, 0, ""}, "JSON nested too deeply");
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

std::uint64_t read32(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
    std::uint64_t value = 0;
    for (int i = 3; i >= 0; --i) value = (value << 8) | bytes[offset + i];
    return value;
}

/// The chunks of a GLB file, which all lie inside it.
GltfChunks glbChunks(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    const auto fail = [&](const std::string& message) { throw InputError({path, 0, ""}, message); };
    if (bytes.size() < 20) fail("truncated GLB header");
    if (read32(bytes, 4) != 2)
        fail(fmt::format("GLB version {} is not supported; convert to glTF 2.0", read32(bytes, 4)));
    if (read32(bytes, 8) > bytes.size()) fail("truncated GLB file");
    const std::uint64_t jsonSize = read32(bytes, 12), jsonEnd = 20 + jsonSize;
    if (jsonEnd > bytes.size()) fail("truncated JSON chunk");
    const std::uint64_t binarySize = jsonEnd + 8 <= bytes.size() ? read32(bytes, jsonEnd) : 0;
    if (binarySize > 0 && jsonEnd + 8 + binarySize > bytes.size()) fail("truncated binary chunk");
    return {{reinterpret_cast<const char*>(bytes.data()) + 20, static_cast<std::size_t>(jsonSize)},
            static_cast<std::size_t>(binarySize)};
}

}  // namespace

bool isGlb(const std::vector<std::uint8_t>& bytes) {
    return bytes.size() >= 4 && std::equal(bytes.begin(), bytes.begin() + 4, "glTF");
}

GltfChunks gltfChunks(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    const GltfChunks chunks =
        isGlb(bytes) ? glbChunks(path, bytes)
                     : GltfChunks{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}};
    checkSize(path, chunks.json);
    return chunks;
}

std::string checkGltfJson(const std::string& path, const GltfChunks& chunks, ImportReport& report) {
    json root;
    try {
        root = json::parse(chunks.json);
    } catch (const json::exception& error) {
        throw InputError({path, 0, ""}, fmt::format("not a glTF file: {}", error.what()));
    }
    if (!root.is_object()) throw InputError({path, 0, ""}, "not a glTF file: no JSON object");
    checkVersion(path, root);
    checkTypes(path, root);
    std::string advice = checkExtensions(path, root, report);
    checkBuffers(path, root, chunks.binaryBytes);
    checkAllIndices(path, root);
    checkImageViews(path, root);
    return advice;
}

}  // namespace vlf
