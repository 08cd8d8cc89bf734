#pragma once
// What tells one state of a file from another without reading it.

#include <cstdint>
#include <string>

namespace vlf {

/// A file as it was at one moment. Of a path that is no file, or cannot be asked for, all but the
/// path is zero.
struct FileStamp {
    std::string path;
    std::uint64_t size = 0;
    std::uint64_t inode = 0;               ///< another one after an editor has saved by renaming
    std::int64_t modifiedNanoseconds = 0;  ///< since 1970

    bool operator==(const FileStamp&) const = default;
};

FileStamp stampOf(const std::string& path);

}  // namespace vlf
