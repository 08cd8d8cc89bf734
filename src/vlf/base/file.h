#pragma once
// Whole files in one call.

#include "vlf/base/byte_sink.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vlf {

/// Content of a regular file. Throws FileError.
std::vector<std::uint8_t> readFile(const std::string& path);

/// Makes `bytes` the content of the file `path`: written to a new file in the same folder, flushed
/// to disk and renamed, so that a failure (FileError) leaves the old file and nothing else. A
/// device or pipe is written to directly.
void writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

/// The file behind a symbolic link, else the path itself: what writeFile replaces.
std::string linkTarget(const std::string& path);

/// Removes what processes that were killed in writeFile(path) or with a PendingFile left beside it.
/// No other process may be writing it.
void removeLeftovers(const std::string& path);

/// A file that appears under its name only when it is complete: writeFile for those that write
/// piece by piece, or let another program write.
class PendingFile {
  public:
    /// Nothing is created yet. Throws FileError if `path` is something else than a regular file.
    explicit PendingFile(const std::string& path);
    /// Removes what was not committed.
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    /// Name of the file to write, in the folder of `path`.
    const std::string& name() const { return name_; }

    /// Renames it to `path`, in place of an old file. Throws FileError.
    void commit();

  private:
    std::string path_, target_, name_;
};

/// writeFile piece by piece. A device or pipe gets all of it at the end.
class OutputFile final : public ByteSink {
  public:
    /// Throws FileError, as all its members do.
    explicit OutputFile(const std::string& path);
    ~OutputFile() override;
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void append(std::span<const std::uint8_t> bytes) override;
    void writeStart(std::span<const std::uint8_t> bytes) override;
    std::uint64_t size() const override { return size_; }
    /// Flushes it to disk and gives it its name.
    void commit();

  private:
    void fail() const;

    std::string path_;
    std::optional<PendingFile> pending_;  ///< none: a device
    MemorySink held_;                     ///< for the device
    int file_ = -1;
    std::uint64_t size_ = 0;
};

/// Throws FileError if writeFile could not but fail: `path` is a folder, or its own folder is
/// missing or nothing may be created there. To be asked before long work.
void requireWritable(const std::string& path);

}  // namespace vlf
