#include "vlf/scene/import/gltf_compression.h"

#include "vlf/scene/import/gltf_json.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <optional>
#include <span>

namespace vlf {

namespace {

using nlohmann::json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Largest ratio of the codec: two bits tell that sixteen bytes are zero.
constexpr std::size_t kMostMeshoptRatio = 64;

/// The extension of an element; null if it has none.
const json* extensionOf(const json& element, const char* name, const SourceLocation& where) {
    const auto extensions = element.find("extensions");
    if (extensions == element.end() || !extensions->is_object()) return nullptr;
    const auto found = extensions->find(name);
    if (found == extensions->end()) return nullptr;
    if (!found->is_object()) throw InputError(where, fmt::format("{} must be an object", name));
    return &*found;
}

/// A whole number; if the object has none, `otherwise`.
std::size_t number(const json& object, const char* name, const SourceLocation& where,
                   std::optional<std::size_t> otherwise = std::nullopt) {
    const auto found = object.find(name);
    if (found == object.end() && otherwise) return *otherwise;
    if (found == object.end() || !found->is_number_unsigned())
        throw InputError(where, fmt::format("{} must be a whole number", name));
    return found->get<std::size_t>();
}

std::string word(const json& object, const char* name, const SourceLocation& where,
                 const std::string& otherwise) {
    const auto found = object.find(name);
    if (found == object.end()) return otherwise;
    if (!found->is_string()) throw InputError(where, fmt::format("{} must be a string", name));
    return found->get<std::string>();
}

std::span<const std::uint8_t> slice(const std::vector<GltfBytes>& buffers, std::size_t buffer,
                                    std::size_t offset, std::size_t length,
                                    const SourceLocation& where) {
    if (buffer >= buffers.size())
        throw InputError(where, fmt::format("buffers[{}] does not exist", buffer));
    const GltfBytes& bytes = buffers[buffer];
    if (offset > bytes.size() || length > bytes.size() - offset)
        throw InputError(where, fmt::format("the compressed data lie outside of their buffer of "
                                            "{} bytes",
                                            bytes.size()));
    return std::span(bytes).subspan(offset, length);
}

/// How the extension says that a view is compressed.
struct MeshoptView {
    std::span<const std::uint8_t> bytes;
    std::size_t count, stride;
    std::string mode, filter;
};

MeshoptView meshoptView(const json& extension, const std::vector<GltfBytes>& buffers,
                        const SourceLocation& where) {
    MeshoptView view{slice(buffers, number(extension, "buffer", where),
                           number(extension, "byteOffset", where, 0),
                           number(extension, "byteLength", where), where),
                     number(extension, "count", where), number(extension, "byteStride", where),
                     word(extension, "mode", where, ""), word(extension, "filter", where, "NONE")};
    const bool isVertex = view.mode == "ATTRIBUTES", isTriangles = view.mode == "TRIANGLES";
    if (!isVertex && !isTriangles && view.mode != "INDICES")
        throw InputError(where, fmt::format("mode '{}' does not exist", view.mode));
    const bool strideFits = isVertex ? view.stride % 4 == 0 && view.stride > 0 && view.stride <= 256
                                     : view.stride == 2 || view.stride == 4;
    if (!strideFits || (isTriangles && view.count % 3 != 0) ||
        view.count > kMostMeshoptRatio * view.bytes.size() / view.stride)
        throw InputError(where, "count or byteStride do not fit the compressed data");
    return view;
}

void applyFilter(const MeshoptView& view, GltfBytes& decoded, const SourceLocation& where) {
    const bool isQuad = view.stride == 8;
    if (view.filter == "OCTAHEDRAL" && (isQuad || view.stride == 4))
        meshopt_decodeFilterOct(decoded.data(), view.count, view.stride);
    else if (view.filter == "QUATERNION" && isQuad)
        meshopt_decodeFilterQuat(decoded.data(), view.count, view.stride);
    else if (view.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(decoded.data(), view.count, view.stride);
    else if (view.filter != "NONE")
        throw InputError(where, fmt::format("filter '{}' does not exist or does not fit the "
                                            "byteStride",
                                            view.filter));
}

GltfBytes decodeMeshopt(const MeshoptView& view, const SourceLocation& where) {
    GltfBytes decoded(view.count * view.stride);
    const auto decode = [&](auto decoder) {
        return decoder(decoded.data(), view.count, view.stride, view.bytes.data(),
                       view.bytes.size());
    };
    const int error = view.mode == "ATTRIBUTES" ? decode(meshopt_decodeVertexBuffer)
                      : view.mode == "TRIANGLES"
                          ? decode([](auto... a) { return meshopt_decodeIndexBuffer(a...); })
                          : decode([](auto... a) { return meshopt_decodeIndexSequence(a...); });
    if (error != 0) throw InputError(where, "the compressed data are damaged");
    if (view.mode == "ATTRIBUTES") applyFilter(view, decoded, where);
    return decoded;
}

void decompressView(json& view, std::vector<GltfBytes>& buffers, const SourceLocation& where) {
    const json* extension = extensionOf(view, kMeshopt, where);
    if (!extension) return;
    GltfBytes decoded = decodeMeshopt(meshoptView(*extension, buffers, where), where);
    view["buffer"] = buffers.size();
    view["byteOffset"] = 0;
    view["byteLength"] = decoded.size();
    view.erase("extensions");
    buffers.push_back(std::move(decoded));
}

/// Files may hold the same geometry uncompressed, too.
bool isPlain(const json& primitive, const json& accessors) {
    const auto attributes = primitive.find("attributes");
    const auto hasBytes = [&](const json& accessor) {
        return accessors[accessor.get<std::size_t>()].contains("bufferView");
    };
    return (!primitive.contains("indices") || hasBytes(primitive["indices"])) &&
           (attributes == primitive.end() ||
            std::all_of(attributes->begin(), attributes->end(), hasBytes));
}

void refuseDraco(const json& primitive, const json& accessors, const SourceLocation& where) {
    if (extensionOf(primitive, kDraco, where) && !isPlain(primitive, accessors))
        throw InputError(where, fmt::format("compressed by {}, which is not decoded; export "
                                            "without Draco compression",
                                            kDraco));
}

}  // namespace

void decompressGltf(const std::string& path, json& root, std::vector<GltfBytes>& buffers) {
    if (root.contains("bufferViews")) {
        json& views = root["bufferViews"];
        for (std::size_t i = 0; i < views.size(); ++i)
            decompressView(views[i], buffers, {path, 0, fmt::format("bufferViews[{}]", i)});
    }
    const json& meshes = gltfElements(root, "meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const json& primitives = gltfElements(meshes[m], "primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p)
            refuseDraco(primitives[p], gltfElements(root, "accessors"),
                        {path, 0, fmt::format("meshes[{}].primitives[{}]", m, p)});
    }
}

}  // namespace vlf
