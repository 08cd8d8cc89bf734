#include "vlf/scene/import/gltf_data.h"

#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/gltf_json.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace vlf {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Value of a digit of base64; nothing for other characters.
std::optional<std::uint32_t> base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return std::nullopt;
}

GltfBytes fromBase64(std::string_view text, const SourceLocation& where) {
    while (text.ends_with('=')) text.remove_suffix(1);
    GltfBytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const auto digit = base64Digit(c);
        if (!digit) throw InputError(where, "the data URI is not valid base64");
        bits = bits << 6 | *digit;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> count));
    }
    return bytes;
}

/// With %20 and the like replaced by what they stand for.
std::string percentDecoded(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        std::uint8_t code = 0;
        const char* const digits = uri.data() + i + 1;
        const bool isCode = uri[i] == '%' && i + 2 < uri.size() &&
                            std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        text += isCode ? static_cast<char>(code) : uri[i];
        if (isCode) i += 2;
    }
    return text;
}

class BufferReader {
  public:
    BufferReader(const std::string& document, std::span<const std::uint8_t> binary,
                 ImportReport& report)
        : document_(document), binary_(binary), report_(report) {}

    GltfBytes read(const json& buffer, std::size_t index) {
        const SourceLocation where{document_, 0, fmt::format("buffers[{}]", index)};
        const auto length = buffer.find("byteLength");
        if (length == buffer.end() || *length == 0)
            throw InputError(where, "byteLength must be a number above 0");
        const std::string uri = buffer.value("uri", "");
        if (uri.empty() && (index > 0 || binary_.empty()) && isStandIn(buffer)) return {};
        GltfBytes bytes = uri.empty() ? binaryChunk(index, where) : bytesOfUri(uri, where);
        if (bytes.size() < length->get<std::uint64_t>())
            throw InputError(
                where, fmt::format("announces {} bytes, but {} has {}", length->dump(),
                                   uri.empty() ? "the binary chunk" : "its uri", bytes.size()));
        bytes.resize(length->get<std::size_t>());
        return bytes;
    }

  private:
    static bool isStandIn(const json& buffer) {
        const auto extensions = buffer.find("extensions");
        return extensions != buffer.end() && extensions->is_object() &&
               extensions->contains("EXT_meshopt_compression");
    }

    GltfBytes binaryChunk(std::size_t index, const SourceLocation& where) const {
        if (index > 0 || binary_.empty())
            throw InputError(where, "has neither a uri nor the binary chunk of a GLB file");
        return {binary_.begin(), binary_.end()};
    }

    GltfBytes bytesOfUri(const std::string& uri, const SourceLocation& where) {
        if (auto bytes = dataUriBytes(uri, where)) return std::move(*bytes);
        const std::string path = pathOfUri(document_, uri);
        noteFile(report_, path);
        try {
            return readFileBytes(path);
        } catch (const FileError& error) {
            throw InputError(where, error.what());
        }
    }

    const std::string& document_;
    std::span<const std::uint8_t> binary_;
    ImportReport& report_;
};

}  // namespace

std::optional<GltfBytes> dataUriBytes(const std::string& uri, const SourceLocation& where) {
    if (!uri.starts_with("data:")) return std::nullopt;
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64"))
        throw InputError(where, "the data URI is not in base64");
    return fromBase64(std::string_view(uri).substr(comma + 1), where);
}

std::string pathOfUri(const std::string& document, const std::string& uri) {
    const fs::path folder = fs::path(document).parent_path();
    std::error_code ignored;
    const fs::path asWritten = folder / uri;
    const bool isLiteral = uri.size() < 256 && fs::is_regular_file(asWritten, ignored);
    return (isLiteral ? asWritten : folder / percentDecoded(uri)).string();
}

std::vector<GltfBytes> readGltfBuffers(const std::string& document, const json& root,
                                       std::span<const std::uint8_t> binary, ImportReport& report) {
    BufferReader reader(document, binary, report);
    std::vector<GltfBytes> buffers;
    for (const json& buffer : gltfElements(root, "buffers"))
        buffers.push_back(reader.read(buffer, buffers.size()));
    return buffers;
}

}  // namespace vlf
