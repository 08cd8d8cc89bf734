#include "numbered_file.h"

#include "vlf/base/error.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace vlf::app {

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

}  // namespace vlf::app
