#include "vlf/scene/import/file_bytes.h"

#include "vlf/base/error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace vlf {

namespace {

template <class Bytes>
Bytes readAll(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw FileError(path, "no such file");
    if (!std::filesystem::is_regular_file(status)) throw FileError(path, "not a regular file");
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error) throw FileError(path, error.message());
    if (size > kMaxFileBytes) throw FileError(path, "larger than 4 GiB; split the scene");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw FileError(path, std::string("cannot be opened: ") + std::strerror(errno));
    Bytes bytes(static_cast<std::size_t>(size), 0);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw FileError(path, "cannot be read");
    return bytes;
}

}  // namespace

std::vector<std::uint8_t> readFileBytes(const std::string& path) {
    return readAll<std::vector<std::uint8_t>>(path);
}

std::string readFileText(const std::string& path) {
    std::string text = readAll<std::string>(path);
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        throw InputError({path, 1, ""}, "the text is UTF-16; save it as UTF-8");
    if (std::memchr(text.data(), 0, text.size()))
        throw InputError({path, 0, ""}, "holds binary data where text is expected");
    return text;
}

}  // namespace vlf
