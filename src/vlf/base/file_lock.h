#pragma once
// One process at a time.

#include <string>

namespace vlf {

/// A lock that the processes of a machine hold in turn. It ends with its process, however that
/// ends; the file that stands for it may then be left over and does no harm.
class FileLock {
  public:
    /// Makes the file `path`, or takes one that is left over, and writes the process into it.
    /// Throws FileError if another process, or another FileLock, holds the lock or if the file
    /// cannot be written; `what` is named as what is locked.
    FileLock(const std::string& path, const std::string& what);
    /// Removes the file.
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    std::string path_;
    int file_ = -1;
};

}  // namespace vlf
