#include "vlf/io/light_field_chunks.h"

#include "vlf/io/grid_chunk.h"
#include "vlf/io/radiance_codec.h"
#include "vlf/io/records.h"
#include "vlf/io/validate.h"

#include <cstring>

namespace vlf {

namespace {

/// Irradiance: green, red - green, blue - green, of channels of 12 significant bits.
using IrradianceCodec = GridCodec<std::uint32_t, 3, 3>;
using ChartCodec = GridCodec<std::uint32_t, 17>;
using TileRowCodec = GridCodec<std::uint32_t, 4>;

constexpr int kDroppedBits = 12;            ///< of a float's 23 mantissa bits
constexpr std::uint32_t kChroma = 1 << 20;  ///< keeps differences of channels positive

/// The upper bits of a non-negative float, rounded to nearest, ties to even. The bits of floats
/// are nearly a logarithm: differences of channels do not change with brightness.
std::uint32_t roundedBits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    constexpr std::uint32_t kHalf = (1u << (kDroppedBits - 1)) - 1;
    return (bits + kHalf + (bits >> kDroppedBits & 1)) >> kDroppedBits;
}

IrradianceCodec::Element encodeIrradiance(const Vec3& e) {
    const std::uint32_t g = roundedBits(e.y);
    return {g, roundedBits(e.x) - g + kChroma, roundedBits(e.z) - g + kChroma};
}

Vec3 decodeIrradiance(const IrradianceCodec::Element& code) {
    const auto channel = [](std::uint32_t bits) {
        return std::bit_cast<float>(bits << kDroppedBits);
    };
    return {channel(code[0] + code[1] - kChroma), channel(code[0]),
            channel(code[0] + code[2] - kChroma)};
}

/// The members of a chart but its flag are 32 bits wide and come first.
ChartCodec::Element encodeChart(const Chart& chart) {
    static_assert(offsetof(Chart, planar) == 16 * sizeof(std::uint32_t));
    ChartCodec::Element words{};
    std::memcpy(words.data(), &chart, offsetof(Chart, planar));
    words[16] = chart.planar;
    return words;
}

Chart decodeChart(const ChartCodec::Element& words) {
    Chart chart;
    std::memcpy(static_cast<void*>(&chart), words.data(), offsetof(Chart, planar));
    chart.planar = words[16] != 0;
    return chart;
}

TileRowCodec::Element encodeTileRow(const TileRow& row) {
    return {row.chart, row.tileX, row.tileY, row.tilesWide};
}

TileRow decodeTileRow(const TileRowCodec::Element& words) {
    TileRow row;
    row.chart = words[0];
    row.tileX = static_cast<std::uint16_t>(words[1]);
    row.tileY = static_cast<std::uint16_t>(words[2]);
    row.tilesWide = static_cast<std::uint16_t>(words[3]);
    return row;
}

/// The chunks of a radiance field.
struct RadianceNames {
    const char *subfields, *rows, *elements;
};
constexpr RadianceNames kRadiance{"subfields", "tile rows", "radiance"};
constexpr RadianceNames kGloss{"gloss subfields", "gloss tile rows", "gloss"};

void addRadiance(ChunkFileWriter& file, const RadianceNames& names, const RadianceField& radiance) {
    addArray(file, names.subfields, radiance.firstRow);
    addGrid<TileRowCodec>(file, names.rows, radiance.rows, 1, encodeTileRow);
    const TileGroups groups(radiance);
    file.add(names.elements, groups.count(), [&](std::size_t g) {
        return Block{groups.encode(g), groups.groupElements(g) * sizeof(RadianceElement)};
    });
}

void setFirstElements(RadianceField& radiance) {
    std::uint64_t next = 0;
    for (TileRow& row : radiance.rows) {
        row.firstElement = next;
        next += radiance.tileElements() * row.tilesWide;
    }
}

void readElements(const ChunkFileReader& file, const char* name, RadianceField& radiance) {
    const TileGroups groups(radiance);
    const Chunk& chunk =
        file.chunk(name, groups.count(), groups.elementCount() * sizeof(RadianceElement));
    radiance.elements.resize(groups.elementCount());
    file.read(chunk, [&](std::size_t g, std::span<const std::uint8_t> bytes) {
        if (!groups.decode(g, bytes, radiance.elements))
            throw InputError(file.where(chunk), "a block is not of its tiles' size: bake it again");
    });
}

RadianceField readRadiance(const ChunkFileReader& file, const RadianceNames& names,
                           const RadianceCounts& counts, std::uint64_t charts) {
    RadianceField radiance;
    radiance.lines = counts.lines;
    radiance.cells = counts.cells;
    radiance.tileSize = counts.tileSize;
    radiance.maxDistance = counts.maxDistance;
    const std::uint64_t directions = 2 * static_cast<std::uint64_t>(radiance.lines);
    readArray(file, names.subfields, radiance.firstRow, radiance.empty() ? 0 : directions + 1);
    readGrid<TileRowCodec>(file, names.rows, radiance.rows, {1, counts.tileRows}, decodeTileRow);
    checkRadianceLayout(radiance, charts, file.path());
    setFirstElements(radiance);
    readElements(file, names.elements, radiance);
    return radiance;
}

}  // namespace

void addLightField(ChunkFileWriter& file, const LightField& field) {
    addRecord(file, "bake", field.record);
    addGrid<ChartCodec>(file, "charts", field.charts, 1, encodeChart);
    addArray(file, "triangle charts", field.triangleCharts);
    addGrid<IrradianceCodec>(file, "irradiance", field.atlas.irradiance, field.atlas.width,
                             encodeIrradiance);
    addRadiance(file, kRadiance, field.radiance);
    addRadiance(file, kGloss, field.gloss);
}

LightField readLightField(const ChunkFileReader& file, const FieldCounts& counts) {
    LightField field;
    readRecord(file, "bake", field.record);
    readGrid<ChartCodec>(file, "charts", field.charts, {1, counts.charts}, decodeChart);
    readArray(file, "triangle charts", field.triangleCharts, counts.triangles);
    field.atlas.width = counts.atlasWidth;
    field.atlas.height = counts.atlasHeight;
    readGrid<IrradianceCodec>(file, "irradiance", field.atlas.irradiance,
                              {counts.atlasWidth, counts.atlasHeight}, decodeIrradiance);
    field.radiance = readRadiance(file, kRadiance, counts.radiance, counts.charts);
    field.gloss = readRadiance(file, kGloss, counts.gloss, counts.charts);
    return field;
}

}  // namespace vlf
