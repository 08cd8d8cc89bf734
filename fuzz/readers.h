#pragma once
// Files that nobody vouches for: every kind the program reads, each by the function that reads it,
// and what must hold of what it makes of them. Fuzzers and tests/hostile call these.

#include <cstdint>
#include <span>
#include <vector>

namespace vlf::fuzz {

using Bytes = std::span<const std::uint8_t>;
using Blob = std::vector<std::uint8_t>;

/// Each reads the bytes as a file of its kind. True if they were accepted, false if they were
/// refused with an Error. Throws std::logic_error if what was accepted is not sound: an index out
/// of range, a number that is not finite. Whatever else the program throws comes through.
bool readObj(Bytes bytes);         ///< with a material library, textures and cameras beside it
bool readMtl(Bytes bytes);         ///< as the library of a small OBJ file
bool readCameras(Bytes bytes);     ///< as the cameras beside an OBJ file
bool readGltf(Bytes bytes);        ///< .gltf or .glb, with a buffer and images beside it
bool readPicture(Bytes bytes);     ///< any image format, as texture and as picture
bool readFieldFile(Bytes bytes);   ///< .vlf
bool readCameraPath(Bytes bytes);  ///< with its objects and their models
bool readScenario(Bytes bytes);    ///< with its models

struct Format {
    const char* name;
    bool (*read)(Bytes);
    std::vector<Blob> (*seeds)();  ///< small files that are accepted
};

/// All of the above.
std::span<const Format> formats();

}  // namespace vlf::fuzz
