#pragma once
// The field file (.vlf): a light field together with what is needed to show it, the scene's
// geometry, textures and cameras. Its format is described in docs/file-format.md.

#include "vlf/field/light_field.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vlf {

struct BakedRoom {
    Scene scene;
    LightField field;
};

/// Writes `room` to `path`; the same room gives the same bytes, whatever the number of threads.
/// Scene and layout are stored exactly. Irradiance is rounded to 12 significant bits per channel
/// (relative error <= 0.025 %, 0.01 % RMS), radiance to 8 (<= 0.4 %, 0.16 % RMS), distances to
/// 1/4096 of the longest; what was read is written again without further loss.
/// Throws InputError if an index or number of the room is out of range, FileError if the file
/// cannot be written; an existing file is then left as it was.
void writeField(const std::string& path, const BakedRoom& room);

/// Reads a field file. Every index in the result lies within its array and every number is
/// finite; RadianceField::elements holds the blocks one after the other. Throws FileError if the
/// file cannot be read and InputError, naming file and chunk, if it is damaged, of another
/// version or no field file.
BakedRoom readField(const std::string& path);

/// How much a field file holds.
/// Sizes of a radiance field; no lines: it is empty.
struct RadianceCounts {
    int lines = 0, cells = 0, tileSize = 0;
    float maxDistance = 0;  ///< metres
    std::uint64_t tileRows = 0;
    std::uint64_t elements = 0;
    std::uint64_t filled = 0;  ///< elements with a distance above 0
};

struct FieldCounts {
    std::uint64_t vertices = 0, triangles = 0, meshes = 0, materials = 0, textures = 0;
    std::uint64_t texturePixels = 0, cameras = 0, charts = 0;
    std::uint32_t atlasWidth = 0, atlasHeight = 0;  ///< texels
    RadianceCounts radiance, gloss;

    std::uint64_t texels() const { return std::uint64_t{atlasWidth} * atlasHeight; }
};

struct ChunkInfo {
    std::string name;
    std::uint64_t storedBytes = 0;  ///< on disk
    std::uint64_t memoryBytes = 0;  ///< once loaded
    std::uint64_t blocks = 0;
};

/// A scene's environment without its pixels.
struct EnvironmentInfo {
    std::string name;                    ///< of the picture's file
    Vec3 radiance{0};                    ///< as in Environment
    float turn = 0;                      ///< degrees
    std::int32_t width = 0, height = 0;  ///< pixels; 0: the same all around
};

struct FieldFileInfo {
    std::uint32_t formatVersion = 0;
    std::uint64_t fileBytes = 0;
    std::vector<ChunkInfo> chunks;
    FieldCounts counts;
    FieldFrame frame;
    BakeRecord record;
    std::vector<Mesh> meshes;
    std::vector<Camera> cameras;
    std::vector<PunctualLight> lights;
    EnvironmentInfo environment;
};

/// What is inside a field file, without loading field, geometry or textures. Throws like
/// readField for what it reads.
FieldFileInfo readFieldInfo(const std::string& path);

}  // namespace vlf
