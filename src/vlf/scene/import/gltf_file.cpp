#include "vlf/scene/import/gltf_file.h"

#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/gltf_compression.h"
#include "vlf/scene/import/gltf_json.h"
#include "vlf/scene/import/warn.h"

#include <nlohmann/json.hpp>

namespace vlf {

namespace {

using nlohmann::json;

std::string oneLine(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n'))
        text.replace(i, 1, "; ");
    return text;
}

std::string wordOf(const json& object, const char* name) {
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::vector<GltfImage> findImages(const std::string& path, const json& root, ImportReport& report) {
    std::vector<GltfImage> images;
    for (const json& element : gltfElements(root, "images")) {
        GltfImage image{wordOf(element, "name"), wordOf(element, "uri"),
                        element.value("bufferView", -1)};
        if (image.bufferView < 0 && !image.uri.starts_with("data:"))
            noteFile(report, pathOfUri(path, image.uri));
        images.push_back(std::move(image));
    }
    return images;
}

/// The structure of a document; buffers and images stay empty, as tinygltf does not read those
/// that are missing, compressed or of other formats, and so do lights, which it does not check.
tinygltf::Model modelOf(const std::string& path, json root) {
    for (const char* part : {"buffers", "images", "extensions"}) root.erase(part);
    const std::string text = root.dump();
    tinygltf::Model model;
    std::string error, ignored;
    bool ok = false;
    try {
        ok = tinygltf::TinyGLTF().LoadASCIIFromString(&model, &error, &ignored, text.data(),
                                                      static_cast<unsigned>(text.size()), "");
    } catch (const std::exception& e) {
        error += e.what();
    }
    if (!ok) throw InputError({path, 0, ""}, "not a valid glTF file: " + oneLine(error));
    return model;
}

}  // namespace

GltfFile readGltf(const std::string& path, ImportReport& report) {
    noteFile(report, path);
    const std::vector<std::uint8_t> bytes = readFileBytes(path);
    const GltfChunks chunks = gltfChunks(path, bytes);
    json root = parseGltf(path, chunks.json, report);
    GltfFile file{path, {}, readGltfBuffers(path, root, chunks.binary, report), {}, {}};
    decompressGltf(path, root, file.buffers);
    file.images = findImages(path, root, report);
    file.lights = readGltfLights(path, root, report);
    file.model = modelOf(path, std::move(root));
    return file;
}

}  // namespace vlf
