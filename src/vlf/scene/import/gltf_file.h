#pragma once
// glTF 2.0 and GLB files in memory, and checked access to their data.

#include "vlf/base/error.h"
#include "vlf/math/vector.h"
#include "vlf/scene/import/gltf_data.h"
#include "vlf/scene/import/gltf_light.h"
#include "vlf/scene/import/import.h"

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

namespace vlf {

/// Where the bytes of an image are: in a buffer view, a data URI or a file.
struct GltfImage {
    std::string name, uri;
    int bufferView = -1;
};

/// A glTF document, not compressed, with its buffers. Every index from one element to another
/// exists. The model's own buffers, images and lights are empty.
struct GltfFile {
    std::string path;
    tinygltf::Model model;
    std::vector<GltfBytes> buffers;
    std::vector<GltfImage> images;
    GltfLights lights;

    SourceLocation at(const std::string& element) const { return {path, 0, element}; }
};

/// Reads a .gltf or .glb file (told apart by content) and the buffers beside it. Throws InputError
/// for a malformed file, glTF 1.0 and required extensions that are not supported; other unsupported
/// extensions are reported.
GltfFile readGltf(const std::string& path, ImportReport& report);

/// The elements of an accessor of `components` (1 to 4) numbers, one after the other; normalised
/// integers as fractions, sparse values put in. Throws InputError, naming `element` as the user of
/// the accessor, if it has another type or lies outside of its buffer.
std::vector<float> readNumbers(const GltfFile& file, int accessor, int components,
                               const std::string& element);

/// readNumbers of three or two components as vectors.
std::vector<Vec3> readVec3s(const GltfFile& file, int accessor, const std::string& element);
std::vector<Vec2> readVec2s(const GltfFile& file, int accessor, const std::string& element);

/// The elements of an accessor of unsigned integers, each less than `limit`.
std::vector<std::uint32_t> readIndices(const GltfFile& file, int accessor, std::size_t limit,
                                       const std::string& element);

/// The bytes of an image; empty if its file cannot be read.
GltfBytes imageBytes(const GltfFile& file, int image);

}  // namespace vlf
