#include "vlf/base/file_lock.h"

#include "vlf/base/error.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vlf {

namespace {

[[noreturn]] void fail(const std::string& path) {
    throw FileError(path, "cannot write: " + std::generic_category().message(errno));
}

/// Whether the open file is still the one of that name: its last holder may have removed it.
bool isNamed(int file, const std::string& path) {
    struct stat opened{}, named{};
    return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// " (process 123)", or nothing if the holder has not written it yet.
std::string holder(int file) {
    char text[24] = {};
    const ssize_t size = ::pread(file, text, sizeof text - 1, 0);
    return size > 0 ? " (process " + std::string(text) + ")" : "";
}

/// Opens and locks the file of that name. -1: try again.
int tryLock(const std::string& path, const std::string& what) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) fail(path);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
        const int reason = errno;
        const std::string by = holder(file);
        ::close(file);
        errno = reason;
        if (reason != EWOULDBLOCK) fail(path);
        throw FileError(what, "another program is making this file" + by +
                                  "; wait for it, or choose another name");
    }
    if (isNamed(file, path)) return file;
    ::close(file);
    return -1;
}

}  // namespace

FileLock::FileLock(const std::string& path, const std::string& what) : path_(path) {
    while (file_ < 0) file_ = tryLock(path, what);
    const std::string process = std::to_string(::getpid());
    const auto size = static_cast<ssize_t>(process.size());
    if (::ftruncate(file_, 0) == 0 && ::pwrite(file_, process.data(), process.size(), 0) == size)
        return;
    const int reason = errno;
    ::unlink(path.c_str());
    ::close(file_);
    errno = reason;
    fail(what);
}

FileLock::~FileLock() {
    ::unlink(path_.c_str());
    ::close(file_);
}

}  // namespace vlf
