#include "vlf/scene/import/gltf_file.h"

#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/gltf_json.h"
#include "vlf/scene/import/warn.h"

#include <filesystem>

namespace vlf {

namespace {

namespace fs = std::filesystem;

/// Image loader of tinygltf: keeps the bytes. Those in buffer views are left where they are, as
/// tinygltf does not check that they exist.
bool keepImageBytes(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                    const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// Only files below the document's folder, given as an absolute path, are looked at.
bool fileExists(const std::string& path, void* report) {
    if (!fs::path(path).is_absolute()) return false;
    noteFile(*static_cast<ImportReport*>(report), path);
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool readWholeFile(std::vector<unsigned char>* bytes, std::string* error, const std::string& path,
                   void*) {
    try {
        *bytes = readFileBytes(path);
        return true;
    } catch (const Error& e) {
        *error = e.what();
        return false;
    }
}

std::string oneLine(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n'))
        text.replace(i, 1, "; ");
    return text;
}

/// Reads the document. `advice` follows the message if that fails.
void parse(GltfFile& file, const std::vector<std::uint8_t>& bytes, const std::string& advice,
           ImportReport& report) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keepImageBytes, nullptr);
    loader.SetFsCallbacks({fileExists, [](const std::string& path, void*) { return path; },
                           readWholeFile, nullptr, &report});
    const std::string folder = fs::absolute(file.path).parent_path().string();
    std::string error, ignored;
    const auto size = static_cast<unsigned>(bytes.size());
    bool ok = false;
    try {
        ok = isGlb(bytes) ? loader.LoadBinaryFromMemory(&file.model, &error, &ignored, bytes.data(),
                                                        size, folder)
                          : loader.LoadASCIIFromString(&file.model, &error, &ignored,
                                                       reinterpret_cast<const char*>(bytes.data()),
                                                       size, folder);
    } catch (const std::exception& e) {
        error += e.what();
    }
    if (!ok)
        throw InputError({file.path, 0, ""}, "not a valid glTF file: " + oneLine(error) +
                                                 (advice.empty() ? "" : "; " + advice));
    if (!error.empty()) warn(report, {file.path, 0, ""}, oneLine(error));
}

}  // namespace

GltfFile readGltf(const std::string& path, ImportReport& report) {
    GltfFile file{path, {}};
    noteFile(report, path);
    const std::vector<std::uint8_t> bytes = readFileBytes(path);
    const std::string advice = checkGltfJson(path, gltfChunks(path, bytes), report);
    parse(file, bytes, advice, report);
    return file;
}

}  // namespace vlf
