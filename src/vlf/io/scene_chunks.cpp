#include "vlf/io/scene_chunks.h"

#include "vlf/io/grid_chunk.h"
#include "vlf/io/records.h"

namespace vlf {

namespace {

constexpr int kMaxImageSize = 65536;

using Rgba8 = std::array<std::uint8_t, 4>;
using Rgba8Codec = GridCodec<std::uint8_t, 4>;
using LinearCodec = WordCodec<Vec3>;

/// Red and blue as differences from green, which vary less.
Rgba8 decorrelate(const Rgba8& p) {
    return {static_cast<std::uint8_t>(p[0] - p[1] + 128), p[1],
            static_cast<std::uint8_t>(p[2] - p[1] + 128), p[3]};
}

Rgba8 correlate(const Rgba8& p) {
    return {static_cast<std::uint8_t>(p[0] + p[1] - 128), p[1],
            static_cast<std::uint8_t>(p[2] + p[1] - 128), p[3]};
}

/// The pixels of all textures of one kind. T is const for writing.
template <class T, class Textures, class Pixels>
std::vector<Grid<T>> pixelGrids(Textures& textures, const Pixels& pixelsOf) {
    std::vector<Grid<T>> grids;
    for (auto& t : textures)
        if (T* pixels = pixelsOf(t))
            grids.push_back({pixels, static_cast<std::uint64_t>(t.width),
                             static_cast<std::uint64_t>(t.height)});
    return grids;
}

const Rgba8* srgb8Of(const Texture& t) {
    return t.srgb8.empty() ? nullptr : reinterpret_cast<const Rgba8*>(t.srgb8.data());
}
Rgba8* srgb8Of(Texture& t) {
    return t.srgb8.empty() ? nullptr : reinterpret_cast<Rgba8*>(t.srgb8.data());
}

void addTextures(ChunkFileWriter& file, const std::vector<Texture>& textures) {
    std::vector<TextureRecord> records;
    for (const Texture& t : textures)
        records.push_back({t.name, t.width, t.height, t.wrapU, t.wrapV, t.srgb8.empty()});
    addRecord(file, "textures", records);
    const auto srgb8 = pixelGrids<const Rgba8>(textures, [](auto& t) { return srgb8Of(t); });
    const auto linear = pixelGrids<const Vec3>(
        textures, [](auto& t) { return t.linear.empty() ? nullptr : t.linear.data(); });
    addGrids<Rgba8Codec, Rgba8>(file, "pixels.srgb8", srgb8, decorrelate);
    addGrids<LinearCodec, Vec3>(file, "pixels.linear", linear, [](const Vec3& v) {
        return std::bit_cast<LinearCodec::Element>(v);
    });
}

void checkRecord(const TextureRecord& t, const ChunkFileReader& file) {
    if (t.width < 1 || t.height < 1 || t.width > kMaxImageSize || t.height > kMaxImageSize)
        throw InputError(file.where(file.chunk("textures")),
                         "texture \"" + t.name + "\" has a size outside 1 to 65536");
}

std::vector<GridSize> sizesOf(const std::vector<TextureRecord>& records, bool linear) {
    std::vector<GridSize> sizes;
    for (const TextureRecord& t : records)
        if (t.linear == linear)
            sizes.push_back(
                {static_cast<std::uint64_t>(t.width), static_cast<std::uint64_t>(t.height)});
    return sizes;
}

Texture allocate(const TextureRecord& record) {
    Texture t{record.name, record.width, record.height, {}, {}, record.wrapU, record.wrapV};
    const std::size_t pixels = static_cast<std::size_t>(t.width) * t.height;
    if (record.linear)
        t.linear.resize(pixels);
    else
        t.srgb8.resize(4 * pixels);
    return t;
}

std::vector<Texture> readTextures(const ChunkFileReader& file) {
    std::vector<TextureRecord> records;
    readRecord(file, "textures", records);
    for (const TextureRecord& record : records) checkRecord(record, file);
    const Chunk& srgb8 = gridChunk<Rgba8Codec>(file, "pixels.srgb8", sizesOf(records, false));
    const Chunk& linear = gridChunk<LinearCodec>(file, "pixels.linear", sizesOf(records, true));
    std::vector<Texture> textures;
    for (const TextureRecord& record : records) textures.push_back(allocate(record));
    const auto srgb8Grids = pixelGrids<Rgba8>(textures, [](auto& t) { return srgb8Of(t); });
    const auto linearGrids = pixelGrids<Vec3>(
        textures, [](auto& t) { return t.linear.empty() ? nullptr : t.linear.data(); });
    readGrids<Rgba8Codec, Rgba8>(file, srgb8, srgb8Grids, correlate);
    readGrids<LinearCodec, Vec3>(file, linear, linearGrids, [](const LinearCodec::Element& code) {
        return std::bit_cast<Vec3>(code);
    });
    return textures;
}

Grid<const Vec3> gridOf(const Environment& e) {
    return {e.picture.pixels.data(), static_cast<std::uint64_t>(e.picture.width),
            static_cast<std::uint64_t>(e.picture.height)};
}

void addEnvironment(ChunkFileWriter& file, const Environment& environment) {
    if (environment.isBlack()) return;
    addRecord(file, "environment", infoOf(environment));
    std::vector<Grid<const Vec3>> grids;
    if (!environment.isUniform()) grids.push_back(gridOf(environment));
    addGrids<LinearCodec, Vec3>(file, "sky pixels", grids, [](const Vec3& v) {
        return std::bit_cast<LinearCodec::Element>(v);
    });
}

Environment readEnvironment(const ChunkFileReader& file) {
    const EnvironmentInfo info = readEnvironmentInfo(file);
    if (!file.has("environment")) return {};
    if (info.width < 0 || info.height < 0 || info.width > kMaxImageSize ||
        info.height > kMaxImageSize || (info.width == 0) != (info.height == 0))
        throw InputError(file.where(file.chunk("environment")),
                         "has a size outside 0 to 65536: damaged file, bake it again");
    std::vector<GridSize> sizes;
    if (info.width > 0)
        sizes.push_back(
            {static_cast<std::uint64_t>(info.width), static_cast<std::uint64_t>(info.height)});
    const Chunk& chunk = gridChunk<LinearCodec>(file, "sky pixels", sizes);
    Environment environment{info.name, info.radiance, {}, info.turn};
    std::vector<Grid<Vec3>> grids;
    if (info.width > 0) {
        environment.picture = Image(info.width, info.height);
        grids.push_back({environment.picture.pixels.data(), sizes[0].width, sizes[0].height});
    }
    readGrids<LinearCodec, Vec3>(file, chunk, grids, [](const LinearCodec::Element& code) {
        return std::bit_cast<Vec3>(code);
    });
    return environment;
}

}  // namespace

EnvironmentInfo readEnvironmentInfo(const ChunkFileReader& file) {
    EnvironmentInfo info;
    if (file.has("environment")) readRecord(file, "environment", info);
    return info;
}

std::vector<PunctualLight> readLights(const ChunkFileReader& file) {
    std::vector<PunctualLight> lights;
    if (file.has("lights")) readRecord(file, "lights", lights);
    return lights;
}

EnvironmentInfo infoOf(const Environment& e) {
    return {e.name, e.radiance, e.turn, e.picture.width, e.picture.height};
}

void addScene(ChunkFileWriter& file, const Scene& scene) {
    addRecord(file, "meshes", scene.meshes);
    addRecord(file, "materials", scene.materials);
    addRecord(file, "cameras", scene.cameras);
    addTextures(file, scene.textures);
    if (!scene.lights.empty()) addRecord(file, "lights", scene.lights);
    addEnvironment(file, scene.environment);
    addArray(file, "positions", scene.positions);
    addArray(file, "normals", scene.normals);
    addArray(file, "uvs", scene.uvs);
    addArray(file, "triangles", scene.triangles);
}

Scene readScene(const ChunkFileReader& file, const FieldCounts& counts) {
    Scene scene;
    readRecord(file, "meshes", scene.meshes);
    readRecord(file, "materials", scene.materials);
    readRecord(file, "cameras", scene.cameras);
    scene.textures = readTextures(file);
    scene.lights = readLights(file);
    scene.environment = readEnvironment(file);
    readArray(file, "positions", scene.positions, counts.vertices);
    readArray(file, "normals", scene.normals, counts.vertices);
    readArray(file, "uvs", scene.uvs, counts.vertices);
    readArray(file, "triangles", scene.triangles, counts.triangles);
    return scene;
}

}  // namespace vlf
