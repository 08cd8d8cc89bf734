#include "vlf/base/file.h"

#include "vlf/base/error.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace vlf {

namespace fs = std::filesystem;

namespace {

std::string systemMessage(int code) {
    return std::generic_category().message(code);
}

void writeAll(int file, std::span<const std::uint8_t> bytes, const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) throw FileError(path, "cannot write: " + systemMessage(errno));
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
}

bool isNoRegularFile(const std::string& target) {
    std::error_code ignored;
    return fs::exists(target, ignored) && !fs::is_regular_file(target, ignored);
}

constexpr const char* kPending = ".tmp-";  // then process, '-' and a running number

std::string newNameBeside(const std::string& path) {
    static std::atomic<unsigned> counter{0};
    return path + kPending + std::to_string(::getpid()) + "-" + std::to_string(counter++);
}

fs::path folderOf(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    return folder.empty() ? "." : folder;
}

}  // namespace

std::vector<std::uint8_t> readFile(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw FileError(path, "cannot read: " + error.message());
    if (!fs::is_regular_file(status)) throw FileError(path, "cannot read: not a regular file");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw FileError(path, "cannot read: " + systemMessage(errno));
    std::vector<std::uint8_t> bytes(fs::file_size(path));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream) throw FileError(path, "cannot read: the file ends early or cannot be accessed");
    return bytes;
}

std::string linkTarget(const std::string& path) {
    std::error_code ignored;
    if (!fs::is_symlink(path, ignored)) return path;
    const fs::path target = fs::canonical(path, ignored);
    return target.empty() ? path : target.string();
}

void removeLeftovers(const std::string& path) {
    const std::string target = linkTarget(path);
    const std::string pending = fs::path(target).filename().string() + kPending;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folderOf(target), ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(pending) &&
            name.find_first_not_of("0123456789-", pending.size()) == std::string::npos)
            fs::remove(entry.path(), ignored);
    }
}

void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
    OutputFile file(path);
    file.append(bytes);
    file.commit();
}

OutputFile::OutputFile(const std::string& path) : path_(path) {
    const std::string target = linkTarget(path);
    if (isNoRegularFile(target)) {
        file_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
        pending_.emplace(path);
        file_ = ::open(pending_->name().c_str(), O_WRONLY | O_CLOEXEC | O_CREAT | O_EXCL, 0666);
    }
    if (file_ < 0) fail();
}

OutputFile::~OutputFile() {
    if (file_ >= 0) ::close(file_);
}

void OutputFile::append(std::span<const std::uint8_t> bytes) {
    if (pending_)
        writeAll(file_, bytes, path_);
    else
        held_.append(bytes);
    size_ += bytes.size();
}

void OutputFile::writeStart(std::span<const std::uint8_t> bytes) {
    if (!pending_) {
        held_.writeStart(bytes);
    } else {
        if (::lseek(file_, 0, SEEK_SET) < 0) fail();
        writeAll(file_, bytes, path_);
        if (::lseek(file_, 0, SEEK_END) < 0) fail();
    }
}

void OutputFile::commit() {
    writeAll(file_, held_.bytes(), path_);
    // Some file systems report a full disk only here. EINVAL: a device that cannot be synced.
    if (::fsync(file_) != 0 && errno != EINVAL) fail();
    if (::close(std::exchange(file_, -1)) != 0) fail();
    if (pending_) pending_->commit();
}

void OutputFile::fail() const {
    throw FileError(path_, "cannot write: " + systemMessage(errno));
}

PendingFile::PendingFile(const std::string& path)
    : path_(path), target_(linkTarget(path)), name_(newNameBeside(target_)) {
    if (isNoRegularFile(target_)) throw FileError(path, "cannot write: not a regular file");
}

PendingFile::~PendingFile() {
    ::unlink(name_.c_str());
}

void PendingFile::commit() {
    if (std::rename(name_.c_str(), target_.c_str()) != 0)
        throw FileError(path_, "cannot write: " + systemMessage(errno));
}

void requireWritable(const std::string& path) {
    const std::string target = linkTarget(path);
    std::error_code ignored;
    if (fs::is_directory(target, ignored)) throw FileError(path, "cannot write: it is a folder");
    if (isNoRegularFile(target)) return;
    const fs::path folder = folderOf(target);
    if (!fs::is_directory(folder, ignored))
        throw FileError(path, "there is no folder '" + folder.string() + "'; create it first");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw FileError(
            path, "cannot create a file in '" + folder.string() + "': " + systemMessage(errno));
}

}  // namespace vlf
