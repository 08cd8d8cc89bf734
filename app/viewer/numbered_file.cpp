#include "numbered_file.h"

#include "vlf/base/error.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace vlf::app {

namespace {

/// An empty one, so that nobody else takes the name.
std::string makeNumberedFile(const std::string& stem, const std::string& extension) {
    for (int number = 1;; ++number) {
        const std::string name = fmt::format("{}-{:04}.{}", stem, number, extension);
        const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0) {
            ::close(file);
            return name;
        }
        if (errno != EEXIST)
            throw FileError(name, "cannot write: " + std::generic_category().message(errno));
    }
}

}  // namespace

std::string writeNumberedFile(const std::string& stem, const std::string& extension,
                              const std::function<void(const std::string& name)>& write) {
    const std::string name = makeNumberedFile(stem, extension);
    try {
        write(name);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(name, ignored);
        throw;
    }
    return name;
}

}  // namespace vlf::app
