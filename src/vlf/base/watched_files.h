#pragma once
// Notices that files have been changed by other programs.

#include "vlf/base/file_stamp.h"

#include <vector>

namespace vlf {

/// Looks at a set of files when asked to, a few times a second. That needs no more of the operating
/// system than their times and sizes, works on network drives, and does not mind editors that write
/// a new file and rename it, which watches on a file itself lose.
class WatchedFiles {
  public:
    WatchedFiles() = default;

    /// `files` as they were when they were read: changes since then count.
    explicit WatchedFiles(std::vector<FileStamp> files);

    /// Looks. True if a file was changed, made or removed since the last time this returned true,
    /// and none since the look before: half-written files are waited for.
    bool changed();

  private:
    std::vector<FileStamp> reported_, seen_;
};

}  // namespace vlf
