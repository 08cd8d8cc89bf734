#include "folder_watch.h"

#include <system_error>
#include <utility>

namespace vlf::app {

namespace fs = std::filesystem;

FolderWatch::FolderWatch(std::string folder) : folder_(std::move(folder)), seen_(look()) {}

bool FolderWatch::changed() {
    Times now = look();
    const bool different = now != seen_;
    seen_ = std::move(now);
    return different;
}

FolderWatch::Times FolderWatch::look() const {
    Times times;
    std::error_code ignored;  // a file may go while it is looked at
    if (folder_.empty()) return times;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored))
        times[entry.path().string()] = entry.last_write_time(ignored);
    return times;
}

}  // namespace vlf::app
