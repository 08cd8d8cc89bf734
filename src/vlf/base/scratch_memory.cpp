#include "vlf/base/scratch_memory.h"

#include "vlf/base/error.h"

#include <cerrno>
#include <cstdint>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace vlf {

namespace {

[[noreturn]] void fail(const std::string& folder, std::size_t bytes, int code) {
    throw FileError(folder,
                    "cannot keep " + std::to_string(bytes >> 20) +
                        " MiB there during the bake: " + std::generic_category().message(code));
}

}  // namespace

void* mapScratch(const std::string& folder, std::size_t bytes) {
    std::string name = folder + "/.vlf-scratch-XXXXXX";
    const int file = ::mkostemp(name.data(), O_CLOEXEC);
    if (file < 0) fail(folder, bytes, errno);
    ::unlink(name.c_str());
    // A file with holes would end the process when the disk is full.
    int error = ::posix_fallocate(file, 0, static_cast<off_t>(bytes));
    void* const memory = error != 0
                             ? MAP_FAILED
                             : ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (error == 0 && memory == MAP_FAILED) error = errno;
    ::close(file);
    if (error != 0) fail(folder, bytes, error);
    return memory;
}

void unmapScratch(void* memory, std::size_t bytes) noexcept {
    ::munmap(memory, bytes);
}

void releaseScratch(const void* begin, std::size_t bytes) noexcept {
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto from = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = (from + page - 1) / page * page,
                         last = (from + bytes) / page * page;
    if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
}

}  // namespace vlf
