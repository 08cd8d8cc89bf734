#include "vlf/scene/import/gltf_json.h"

#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace vlf {

namespace {

using nlohmann::json;

constexpr int kMaxJsonDepth = 200;
constexpr std::size_t kMaxJsonBytes = std::size_t{1} << 30;

const std::set<std::string> kSupported = {"EXT_meshopt_compression",
                                          "EXT_texture_webp",
                                          "KHR_lights_punctual",
                                          "KHR_materials_emissive_strength",
                                          "KHR_materials_ior",
                                          "KHR_materials_transmission",
                                          "KHR_materials_volume",
                                          "KHR_mesh_quantization",
                                          "KHR_materials_pbrSpecularGlossiness",
                                          "KHR_texture_transform"};

/// Extensions without which a scene can still be shown, even if they are required.
bool isDispensable(const std::string& extension) {
    return extension.starts_with("KHR_materials_") || extension == "KHR_texture_basisu" ||
           extension == "KHR_xmp_json_ld";
}

bool isArray(const json& value) {
    return value.is_array();
}
bool isObject(const json& value) {
    return value.is_object();
}
bool isString(const json& value) {
    return value.is_string();
}
bool isFlag(const json& value) {
    return value.is_boolean();
}
bool isWhole(const json& value) {
    return value.is_number_unsigned();
}
bool isNumbers(const json& value) {
    return value.is_array() && std::all_of(value.begin(), value.end(),
                                           [](const json& item) { return item.is_number(); });
}

/// Properties of the elements of a collection and what they must be if they are there.
struct Property {
    const char *collection, *name;
    bool (*isRight)(const json&);
    const char* type;
};
constexpr Property kProperties[] = {
    {"nodes", "matrix", isNumbers, "an array of numbers"},
    {"nodes", "translation", isNumbers, "an array of numbers"},
    {"nodes", "rotation", isNumbers, "an array of numbers"},
    {"nodes", "scale", isNumbers, "an array of numbers"},
    {"nodes", "weights", isNumbers, "an array of numbers"},
    {"nodes", "children", isArray, "an array"},
    {"scenes", "nodes", isArray, "an array"},
    {"meshes", "primitives", isArray, "an array"},
    {"meshes", "weights", isNumbers, "an array of numbers"},
    {"primitives", "attributes", isObject, "an object"},
    {"primitives", "targets", isArray, "an array"},
    {"primitives", "mode", isWhole, "a whole number"},
    {"skins", "joints", isArray, "an array"},
    {"accessors", "byteOffset", isWhole, "a whole number"},
    {"accessors", "count", isWhole, "a whole number"},
    {"accessors", "componentType", isWhole, "a whole number"},
    {"accessors", "type", isString, "a string"},
    {"accessors", "normalized", isFlag, "true or false"},
    {"accessors", "sparse", isObject, "an object"},
    {"bufferViews", "byteOffset", isWhole, "a whole number"},
    {"bufferViews", "byteLength", isWhole, "a whole number"},
    {"bufferViews", "byteStride", isWhole, "a whole number"},
    {"buffers", "byteLength", isWhole, "a whole number"},
    {"buffers", "uri", isString, "a string"},
    {"images", "uri", isString, "a string"},
    {"materials", "pbrMetallicRoughness", isObject, "an object"},
    {"materials", "emissiveFactor", isNumbers, "an array of numbers"},
};

/// Properties that hold indices into a collection of the root, one or (in arrays and objects) more.
struct Reference {
    const char *collection, *name, *target;
};
constexpr Reference kReferences[] = {
    {"scenes", "nodes", "nodes"},
    {"nodes", "children", "nodes"},
    {"nodes", "mesh", "meshes"},
    {"nodes", "skin", "skins"},
    {"nodes", "camera", "cameras"},
    {"primitives", "attributes", "accessors"},
    {"primitives", "targets", "accessors"},
    {"primitives", "indices", "accessors"},
    {"primitives", "material", "materials"},
    {"skins", "joints", "nodes"},
    {"skins", "inverseBindMatrices", "accessors"},
    {"accessors", "bufferView", "bufferViews"},
    {"bufferViews", "buffer", "buffers"},
    {"textures", "source", "images"},
    {"textures", "sampler", "samplers"},
    {"images", "bufferView", "bufferViews"},
};

void checkReference(const SourceLocation& where, const json& value, const char* target,
                    std::size_t count) {
    if (value.is_structured()) {
        for (const auto& [key, item] : value.items()) {
            const std::string place = value.is_array() ? "[" + key + "]" : "." + key;
            checkReference({where.file, 0, where.element + place}, item, target, count);
        }
    } else if (!value.is_number_unsigned() || value >= count) {
        throw InputError(where, fmt::format("{}[{}] does not exist", target, value.dump()));
    }
}

/// Checks that every "...Texture" of a material, in extensions too, refers to one.
void checkTextures(const SourceLocation& where, const json& material, std::size_t textures) {
    if (!material.is_object()) return;
    for (const auto& [key, value] : material.items()) {
        if (key == "extras" || !value.is_object()) continue;
        const SourceLocation here{where.file, 0, where.element + "." + key};
        const bool isTexture = key.ends_with("Texture");
        if (isTexture && !value.contains("index"))
            throw InputError(here, "has no index of a texture");
        if (isTexture) checkReference(here, value["index"], "textures", textures);
        checkTextures(here, value, textures);
    }
}

/// Checks the elements of the root's collections, and of arrays within them.
class Checker {
  public:
    Checker(const std::string& path, const json& root) : path_(path), root_(root) {}

    void run() const {
        for (const char* name :
             {"scenes", "nodes", "meshes", "skins", "cameras", "accessors", "bufferViews",
              "buffers", "materials", "textures", "images", "samplers"})
            checkCollection(root_, name, "");
        if (const auto scene = root_.find("scene"); scene != root_.end())
            checkReference(at("scene"), *scene, "scenes", gltfElements(root_, "scenes").size());
    }

  private:
    SourceLocation at(const std::string& element) const { return {path_, 0, element}; }

    void checkCollection(const json& parent, const std::string& name,
                         const std::string& prefix) const {
        const auto found = parent.find(name);
        if (found == parent.end()) return;
        if (!found->is_array()) throw InputError(at(prefix + name), "must be an array");
        for (std::size_t i = 0; i < found->size(); ++i)
            checkElement((*found)[i], name, fmt::format("{}{}[{}]", prefix, name, i));
    }

    void checkElement(const json& value, const std::string& collection,
                      const std::string& element) const {
        if (!value.is_object()) throw InputError(at(element), "must be an object");
        for (const Property& property : kProperties) {
            const auto found = value.find(property.name);
            if (property.collection == collection && found != value.end() &&
                !property.isRight(*found))
                throw InputError(at(element + "." + property.name),
                                 fmt::format("must be {}", property.type));
        }
        for (const Reference& reference : kReferences) {
            const auto found = value.find(reference.name);
            if (reference.collection == collection && found != value.end())
                checkReference(at(element + "." + reference.name), *found, reference.target,
                               gltfElements(root_, reference.target).size());
        }
        if (collection == "meshes") checkCollection(value, "primitives", element + ".");
        if (collection == "materials")
            checkTextures(at(element), value, gltfElements(root_, "textures").size());
    }

    const std::string& path_;
    const json& root_;
};

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

void checkExtensions(const std::string& path, const json& root, ImportReport& report) {
    for (const std::string& name : names(path, root, "extensionsRequired"))
        if (!kSupported.contains(name) && !isDispensable(name))
            throw InputError({path, 0, "extensionsRequired"},
                             name + " is not supported; export without it");
    for (const std::string& name : names(path, root, "extensionsUsed"))
        if (!kSupported.contains(name))
            warn(report, {path, 0, "extensionsUsed"}, name + " is not supported and left out");
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

bool isGlb(const std::vector<std::uint8_t>& bytes) {
    return bytes.size() >= 4 && std::equal(bytes.begin(), bytes.begin() + 4, "glTF");
}

std::uint32_t read32(std::span<const std::uint8_t> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = (value << 8) | bytes[offset + i];
    return value;
}

/// Cuts a chunk, each of a length, a type and its content, from the front.
std::span<const std::uint8_t> takeChunk(const std::string& path,
                                        std::span<const std::uint8_t>& rest) {
    const std::size_t length = rest.size() < 8 ? 0 : read32(rest, 0);
    if (rest.size() < 8 || length > rest.size() - 8)
        throw InputError({path, 0, ""}, "truncated GLB file: a chunk ends after the file");
    const auto chunk = rest.subspan(8, length);
    rest = rest.subspan(8 + length);
    return chunk;
}

GltfChunks glbChunks(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
    const auto fail = [&](const std::string& message) { throw InputError({path, 0, ""}, message); };
    if (bytes.size() < 12) fail("truncated GLB header");
    if (const std::uint32_t version = read32(bytes, 4); version != 2)
        fail(fmt::format("GLB version {} is not supported; convert to glTF 2.0", version));
    const std::uint32_t length = read32(bytes, 8);
    if (length > bytes.size()) fail("truncated GLB file");
    if (length < 20) fail("a GLB file without a chunk");
    auto rest = std::span(bytes).subspan(12, length - 12);
    if (read32(rest, 4) != kJson) fail("the first chunk of a GLB file must be JSON");
    const auto text = takeChunk(path, rest);
    GltfChunks chunks{{reinterpret_cast<const char*>(text.data()), text.size()}, {}};
    if (!rest.empty()) {
        const bool isBinary = rest.size() >= 8 && read32(rest, 4) == kBinary;
        const auto second = takeChunk(path, rest);
        if (isBinary) chunks.binary = second;
    }
    return chunks;
}

}  // namespace

const json& gltfElements(const json& parent, const char* collection) {
    static const json kNone = json::array();
    const auto found = parent.find(collection);
    return found == parent.end() ? kNone : *found;
}

GltfChunks gltfChunks(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    const GltfChunks chunks =
        isGlb(bytes) ? glbChunks(path, bytes)
                     : GltfChunks{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}};
    checkSize(path, chunks.json);
    return chunks;
}

json parseGltf(const std::string& path, std::string_view text, ImportReport& report) {
    json root;
    try {
        root = json::parse(text);
    } catch (const json::exception& error) {
        throw InputError({path, 0, ""}, fmt::format("not a glTF file: {}", error.what()));
    }
    if (!root.is_object()) throw InputError({path, 0, ""}, "not a glTF file: no JSON object");
    checkVersion(path, root);
    checkExtensions(path, root, report);
    Checker(path, root).run();
    return root;
}

}  // namespace vlf
