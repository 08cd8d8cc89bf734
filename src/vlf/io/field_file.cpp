#include "vlf/io/field_file.h"

#include "vlf/base/file.h"
#include "vlf/io/checkpoint_file.h"
#include "vlf/io/chunk_file.h"
#include "vlf/io/light_field_chunks.h"
#include "vlf/io/records.h"
#include "vlf/io/scene_chunks.h"
#include "vlf/io/validate.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace vlf {

namespace {

constexpr std::array<std::string_view, 24> kChunks = {
    "summary",         "meshes",          "materials",  "cameras",   "textures",    "pixels.srgb8",
    "pixels.linear",   "positions",       "normals",    "uvs",       "triangles",   "bake",
    "charts",          "triangle charts", "irradiance", "subfields", "tile rows",   "radiance",
    "gloss subfields", "gloss tile rows", "gloss",      "lights",    "environment", "sky pixels"};

/// The chunk "summary": the sizes of all arrays, and where the field lies.
struct Summary {
    FieldCounts counts;
    FieldFrame frame;
};

template <class S>
void describe(S& s, Field<S, Summary> summary) {
    s(summary.counts, summary.frame);
}

std::uint64_t texturePixels(const Scene& scene) {
    std::uint64_t sum = 0;
    for (const Texture& t : scene.textures) sum += static_cast<std::uint64_t>(t.width) * t.height;
    return sum;
}

std::uint64_t filledElements(const RadianceField& radiance) {
    constexpr std::size_t kPiece = 1 << 20;
    std::ptrdiff_t filled = 0;
    for (std::size_t first = 0; first < radiance.elements.size(); first += kPiece) {
        const std::size_t count = std::min(kPiece, radiance.elements.size() - first);
        const RadianceElement* const piece = radiance.elements.data() + first;
        filled += std::count_if(piece, piece + count,
                                [](const RadianceElement& e) { return e.distance > 0; });
        radiance.release(first, count);
    }
    return static_cast<std::uint64_t>(filled);
}

RadianceCounts countsOf(const RadianceField& radiance) {
    return {.lines = radiance.lines,
            .cells = radiance.cells,
            .tileSize = radiance.tileSize,
            .maxDistance = radiance.maxDistance,
            .tileRows = radiance.rows.size(),
            .elements = radiance.elements.size(),
            .filled = filledElements(radiance)};
}

FieldCounts countsOf(const BakedRoom& room) {
    const Scene& scene = room.scene;
    const LightField& field = room.field;
    return {.vertices = scene.positions.size(),
            .triangles = scene.triangles.size(),
            .meshes = scene.meshes.size(),
            .materials = scene.materials.size(),
            .textures = scene.textures.size(),
            .texturePixels = texturePixels(scene),
            .cameras = scene.cameras.size(),
            .charts = field.charts.size(),
            .atlasWidth = field.atlas.width,
            .atlasHeight = field.atlas.height,
            .radiance = countsOf(field.radiance),
            .gloss = countsOf(field.gloss)};
}

void checkRoom(const BakedRoom& room, const std::string& path) {
    checkScene(room.scene, path);
    checkCharts(room.field, room.scene, path);
    checkAtlas(room.field.atlas, path);
    checkBakeRecord(room.field.record, path);
}

ChunkFileReader open(const std::string& path) {
    ChunkFileReader file(path);
    if (file.has(kIdentityChunk))
        throw InputError(SourceLocation{path, 0, ""},
                         "is the checkpoint of an unfinished bake; finish it with bake --resume");
    file.rejectUnknown(kChunks);
    return file;
}

Summary readSummary(const ChunkFileReader& file) {
    Summary summary;
    readRecord(file, "summary", summary);
    const FieldCounts& c = summary.counts;
    constexpr std::uint64_t kMaxCount = 0xffffffff;  // of what 32-bit indices can reach
    const bool countable = std::max({c.vertices, c.triangles, c.charts, c.radiance.tileRows,
                                     c.gloss.tileRows}) < kMaxCount;
    if (!countable || c.radiance.lines < 0 || c.gloss.lines < 0 ||
        !isFinite(summary.frame.centre) || !std::isfinite(summary.frame.radius))
        throw InputError({file.path(), 0, "chunk summary"}, "impossible numbers: bake it again");
    return summary;
}

}  // namespace

void writeField(const std::string& path, const BakedRoom& room) {
    checkRoom(room, path);
    for (const RadianceField* radiance : {&room.field.radiance, &room.field.gloss}) {
        checkRadianceLayout(*radiance, room.field.charts.size(), path);
        checkRadianceElements(*radiance, path);
    }
    OutputFile output(path);
    ChunkFileWriter file(output);
    addRecord(file, "summary", Summary{countsOf(room), room.field.frame});
    addScene(file, room.scene);
    addLightField(file, room.field);
    file.finish();
    output.commit();
}

BakedRoom readField(const std::string& path) {
    const ChunkFileReader file = open(path);
    const Summary summary = readSummary(file);
    BakedRoom room{readScene(file, summary.counts), readLightField(file, summary.counts)};
    room.field.frame = summary.frame;
    checkRoom(room, path);
    return room;
}

FieldFileInfo readFieldInfo(const std::string& path) {
    const ChunkFileReader file = open(path);
    const Summary summary = readSummary(file);
    FieldFileInfo info{.formatVersion = kFormatVersion,
                       .fileBytes = file.fileBytes(),
                       .chunks = {},
                       .counts = summary.counts,
                       .frame = summary.frame,
                       .record = {},
                       .meshes = {},
                       .cameras = {},
                       .lights = readLights(file),
                       .environment = readEnvironmentInfo(file)};
    for (const Chunk& c : file.chunks())
        info.chunks.push_back({c.name, c.storedBytes(), c.memoryBytes(), c.blocks.size()});
    readRecord(file, "bake", info.record);
    readRecord(file, "meshes", info.meshes);
    readRecord(file, "cameras", info.cameras);
    return info;
}

}  // namespace vlf
