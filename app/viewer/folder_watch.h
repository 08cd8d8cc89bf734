#pragma once
// Notices changes of the files in a folder.

#include <filesystem>
#include <map>
#include <string>

namespace vlf::app {

class FolderWatch {
  public:
    /// Empty: no folder, nothing ever changes.
    explicit FolderWatch(std::string folder);

    /// Whether files have come, gone or been written since the last call or the beginning.
    bool changed();

  private:
    using Times = std::map<std::string, std::filesystem::file_time_type>;

    Times look() const;

    std::string folder_;
    Times seen_;
};

}  // namespace vlf::app
