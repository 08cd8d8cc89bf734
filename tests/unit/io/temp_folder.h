#pragma once
// A folder of the test's own, gone with the object.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vlf::test {

class TempFolder {
  public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    std::string file(const std::string& name) const { return (path_ / name).string(); }
    std::size_t fileCount() const;

  private:
    std::filesystem::path path_;
};

/// Overwrites the file without the care that writeFile takes.
void putBytes(const std::string& path, const std::vector<std::uint8_t>& bytes);

}  // namespace vlf::test
