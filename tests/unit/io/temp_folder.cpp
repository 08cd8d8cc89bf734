#include "unit/io/temp_folder.h"

#include <fstream>
#include <iterator>
#include <random>

namespace vlf::test {

namespace fs = std::filesystem;

TempFolder::TempFolder()
    : path_(fs::temp_directory_path() / ("vlf_io_" + std::to_string(std::random_device{}()))) {
    fs::create_directories(path_);
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::size_t TempFolder::fileCount() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), {}));
}

void putBytes(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    fs::remove(path);  // some file systems flush a file that is emptied and filled again
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
}

}  // namespace vlf::test
