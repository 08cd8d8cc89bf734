// fuzz_seeds FOLDER: writes the seeds of every format into a folder of its name.

#include "fuzz/readers.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace {

void writeSeeds(const std::filesystem::path& folder, const vlf::fuzz::Format& format) {
    std::filesystem::create_directories(folder);
    int number = 0;
    for (const vlf::fuzz::Blob& seed : format.seeds()) {
        if (!format.read(seed)) throw vlf::Error(std::string(format.name) + ": a seed is refused");
        vlf::writeFile(folder / ("seed-" + std::to_string(number++)), seed);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
        return 2;
    }
    try {
        for (const vlf::fuzz::Format& format : vlf::fuzz::formats())
            writeSeeds(std::filesystem::path(argv[1]) / format.name, format);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "fuzz_seeds: %s\n", e.what());
        return 1;
    }
}
