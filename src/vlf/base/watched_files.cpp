#include "vlf/base/watched_files.h"

#include <utility>

namespace vlf {

WatchedFiles::WatchedFiles(std::vector<FileStamp> files)
    : reported_(std::move(files)), seen_(reported_) {}

bool WatchedFiles::changed() {
    std::vector<FileStamp> now;
    for (const FileStamp& file : seen_) now.push_back(stampOf(file.path));
    const bool atRest = now == seen_;
    seen_ = std::move(now);
    if (!atRest || seen_ == reported_) return false;
    reported_ = seen_;
    return true;
}

}  // namespace vlf
