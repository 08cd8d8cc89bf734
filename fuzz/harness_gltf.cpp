#include "fuzz/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    vlf::fuzz::readGltf({data, size});
    return 0;
}
