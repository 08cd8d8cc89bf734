#include "fuzz/scratch.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <unistd.h>

namespace vlf::fuzz {

namespace {

namespace fs = std::filesystem;

class Folder {
  public:
    Folder() {
        const bool inMemory = !std::getenv("TMPDIR") && fs::is_directory("/dev/shm");
        const fs::path parent = inMemory ? fs::path("/dev/shm") : fs::temp_directory_path();
        path_ = parent / ("vlf-fuzz-" + std::to_string(::getpid()));
        fs::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

}  // namespace

std::string scratchPath(const std::string& name) {
    static const Folder folder;
    return (folder.path() / name).string();
}

std::string putFile(const std::string& name, Bytes bytes) {
    const std::string path = scratchPath(name);
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    if (!stream.flush()) throw std::runtime_error(path + " cannot be written");
    return path;
}

Blob toBlob(const std::string& text) {
    return {text.begin(), text.end()};
}

}  // namespace vlf::fuzz
