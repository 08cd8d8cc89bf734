#include "vlf/base/file_stamp.h"

#include <sys/stat.h>

namespace vlf {

FileStamp stampOf(const std::string& path) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    struct stat s {};
    if (stat(path.c_str(), &s) != 0 || !S_ISREG(s.st_mode)) return {.path = path};
    return {.path = path,
            .size = static_cast<std::uint64_t>(s.st_size),
            .inode = s.st_ino,
            .modifiedNanoseconds = kSecond * s.st_mtim.tv_sec + s.st_mtim.tv_nsec};
}

}  // namespace vlf
