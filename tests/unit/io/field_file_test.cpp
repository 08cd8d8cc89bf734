#include "vlf/io/field_file.h"

#include "unit/io/example_room.h"
#include "unit/io/temp_folder.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/base/parallel.h"

#include <cmath>
#include <csignal>
#include <cstring>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace vlf {
namespace {

using test::ExampleSize;
using test::makeExampleRoom;
using test::TempFolder;

BakedRoom throughFile(const BakedRoom& room) {
    const TempFolder folder;
    writeField(folder.file("room.vlf"), room);
    return readField(folder.file("room.vlf"));
}

template <class T>
void expectSameBits(const std::vector<T>& a, const std::vector<T>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST(FieldFile, KeepsGeometryExactly) {
    const BakedRoom room = makeExampleRoom(), read = throughFile(room);
    expectSameBits(read.scene.positions, room.scene.positions);
    expectSameBits(read.scene.normals, room.scene.normals);
    expectSameBits(read.scene.uvs, room.scene.uvs);
    expectSameBits(read.scene.triangles, room.scene.triangles);
    expectSameBits(read.field.triangleCharts, room.field.triangleCharts);
    ASSERT_EQ(read.scene.meshes.size(), room.scene.meshes.size());
    for (std::size_t i = 0; i < read.scene.meshes.size(); ++i) {
        EXPECT_EQ(read.scene.meshes[i].name, room.scene.meshes[i].name);
        EXPECT_EQ(read.scene.meshes[i].firstTriangle, room.scene.meshes[i].firstTriangle);
        EXPECT_EQ(read.scene.meshes[i].triangleCount, room.scene.meshes[i].triangleCount);
    }
}

TEST(FieldFile, KeepsLightsAndTheEnvironmentExactly) {
    BakedRoom room = makeExampleRoom();
    EXPECT_TRUE(throughFile(room).scene.lights.empty());
    EXPECT_TRUE(throughFile(room).scene.environment.isBlack());
    room.scene.lights.resize(2);
    PunctualLight& spot = room.scene.lights[1];
    spot = {"spot", PunctualKind::spot, {1, 2, 3}, {0, 1, 0}, {4, 5, 6}, 0.1f, 0.7f};
    room.scene.environment = {"sky.hdr", {1, 0.5f, 2}, Image(6, 3, Vec3(0.25f)), 12.5f};
    room.scene.environment.picture.at(5, 2) = {7, 8, 1e-9f};
    const Scene read = throughFile(room).scene;
    ASSERT_EQ(read.lights.size(), 2u);
    EXPECT_EQ(read.lights[1].name, "spot");
    EXPECT_EQ(read.lights[1].kind, PunctualKind::spot);
    EXPECT_EQ(read.lights[1].position, spot.position);
    EXPECT_EQ(read.lights[1].direction, spot.direction);
    EXPECT_EQ(read.lights[1].intensity, spot.intensity);
    EXPECT_EQ(read.lights[1].innerCone, spot.innerCone);
    EXPECT_EQ(read.lights[1].outerCone, spot.outerCone);
    EXPECT_EQ(read.environment.name, "sky.hdr");
    EXPECT_EQ(read.environment.radiance, Vec3(1, 0.5f, 2));
    EXPECT_EQ(read.environment.turn, 12.5f);
    expectSameBits(read.environment.picture.pixels, room.scene.environment.picture.pixels);
    room.scene.environment.picture = {};  // the same all around
    EXPECT_TRUE(throughFile(room).scene.environment.isUniform());
}

TEST(FieldFile, RefusesLightsAndEnvironmentsThatAreNone) {
    const auto refused = [](const std::function<void(Scene&)>& damage) {
        BakedRoom room = makeExampleRoom();
        room.scene.lights.resize(1);
        room.scene.environment.radiance = Vec3(1);
        damage(room.scene);
        const TempFolder folder;
        EXPECT_THROW(writeField(folder.file("room.vlf"), room), InputError);
    };
    refused([](Scene& s) { s.lights[0].intensity.y = -1; });
    refused([](Scene& s) { s.lights[0].direction = Vec3(0); });
    refused([](Scene& s) { s.lights[0].position.x = std::nanf(""); });
    refused([](Scene& s) { s.lights[0].outerCone = 3; });
    refused([](Scene& s) { s.environment.radiance.z = std::nanf(""); });
    refused([](Scene& s) { s.environment.picture = Image(2, 1, Vec3(-1)); });
    refused([](Scene& s) { s.environment.picture.width = 3; });
}

TEST(FieldFile, KeepsMaterialsExactly) {
    const BakedRoom room = makeExampleRoom(), read = throughFile(room);
    ASSERT_EQ(read.scene.materials.size(), room.scene.materials.size());
    for (std::size_t i = 0; i < read.scene.materials.size(); ++i) {
        const Material &a = read.scene.materials[i], &b = room.scene.materials[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.diffuse, b.diffuse);
        EXPECT_EQ(a.mirror, b.mirror);
        EXPECT_EQ(a.roughness, b.roughness);
        EXPECT_EQ(a.emission, b.emission);
        EXPECT_EQ(a.diffuseTexture, b.diffuseTexture);
        EXPECT_EQ(a.mirrorTexture, b.mirrorTexture);
        EXPECT_EQ(a.emissionTexture, b.emissionTexture);
        EXPECT_EQ(a.emitsBothSides, b.emitsBothSides);
    }
}

TEST(FieldFile, KeepsTexturesAndCamerasExactly) {
    const BakedRoom room = makeExampleRoom(), read = throughFile(room);
    ASSERT_EQ(read.scene.textures.size(), room.scene.textures.size());
    for (std::size_t i = 0; i < read.scene.textures.size(); ++i) {
        const Texture &a = read.scene.textures[i], &b = room.scene.textures[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.width, b.width);
        EXPECT_EQ(a.height, b.height);
        EXPECT_EQ(a.wrapU, b.wrapU);
        EXPECT_EQ(a.wrapV, b.wrapV);
        EXPECT_EQ(a.srgb8, b.srgb8);
        expectSameBits(a.linear, b.linear);
    }
    ASSERT_EQ(read.scene.cameras.size(), room.scene.cameras.size());
    for (std::size_t i = 0; i < read.scene.cameras.size(); ++i) {
        const Camera &a = read.scene.cameras[i], &b = room.scene.cameras[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.eye, b.eye);
        EXPECT_EQ(a.look, b.look);
        EXPECT_EQ(a.up, b.up);
        EXPECT_EQ(a.verticalFov, b.verticalFov);
    }
}

TEST(FieldFile, KeepsChartsExactly) {
    const BakedRoom room = makeExampleRoom(), read = throughFile(room);
    ASSERT_EQ(read.field.charts.size(), room.field.charts.size());
    for (std::size_t i = 0; i < read.field.charts.size(); ++i) {
        const Chart &a = read.field.charts[i], &b = room.field.charts[i];
        EXPECT_EQ(a.uAxis, b.uAxis);
        EXPECT_EQ(a.vAxis, b.vAxis);
        EXPECT_EQ(a.uOffset, b.uOffset);
        EXPECT_EQ(a.vOffset, b.vOffset);
        EXPECT_EQ(a.normal, b.normal);
        EXPECT_EQ(a.x, b.x);
        EXPECT_EQ(a.y, b.y);
        EXPECT_EQ(a.width, b.width);
        EXPECT_EQ(a.height, b.height);
        EXPECT_EQ(a.material, b.material);
        EXPECT_EQ(a.planar, b.planar);
    }
}

TEST(FieldFile, KeepsFrameAndBakeRecordExactly) {
    const BakedRoom room = makeExampleRoom(), read = throughFile(room);
    const BakeRecord &a = read.field.record, &b = room.field.record;
    EXPECT_EQ(read.field.frame.centre, room.field.frame.centre);
    EXPECT_EQ(read.field.frame.radius, room.field.frame.radius);
    EXPECT_EQ(a.programVersion, b.programVersion);
    EXPECT_EQ(a.instructionSet, b.instructionSet);
    EXPECT_EQ(a.sceneHash, b.sceneHash);
    EXPECT_EQ(a.preset, b.preset);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.directions, b.directions);
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.radianceDirections, b.radianceDirections);
    EXPECT_EQ(a.radianceCells, b.radianceCells);
    EXPECT_EQ(a.glossDirections, b.glossDirections);
    EXPECT_EQ(a.glossCells, b.glossCells);
    EXPECT_EQ(a.tileSize, b.tileSize);
    EXPECT_EQ(a.texelSize, b.texelSize);
    EXPECT_EQ(a.directSamples, b.directSamples);
    EXPECT_EQ(a.bounces, b.bounces);
    EXPECT_EQ(a.residual, b.residual);
    EXPECT_EQ(a.texelError, b.texelError);
    EXPECT_EQ(a.interpolatedError, b.interpolatedError);
    EXPECT_EQ(a.energy.emitted, b.energy.emitted);
    EXPECT_EQ(a.energy.absorbed, b.energy.absorbed);
    EXPECT_EQ(a.energy.unshot, b.energy.unshot);
    EXPECT_EQ(a.energy.escaped, b.energy.escaped);
}

TEST(FieldFile, IrradianceIsRoundedWithinItsBoundAndWithoutBias) {
    const BakedRoom room = makeExampleRoom({.texelsPerMetre = 40, .lines = 0});
    const BakedRoom read = throughFile(room);
    const auto &expected = room.field.atlas.irradiance, &actual = read.field.atlas.irradiance;
    ASSERT_EQ(read.field.atlas.width, room.field.atlas.width);
    ASSERT_EQ(actual.size(), expected.size());
    glm::dvec3 sum(0), sumExpected(0);
    double squares = 0;
    for (std::size_t i = 0; i < actual.size(); ++i) {
        const double error = test::largestRelativeError(actual[i], expected[i]);
        ASSERT_LE(error, 1.0 / 4096) << i;
        squares += error * error;
        sum += glm::dvec3(actual[i]);
        sumExpected += glm::dvec3(expected[i]);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(actual.size())), 2e-4);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / sumExpected[c], 1, 2e-6);
}

TEST(FieldFile, AnyBrightnessOfIrradianceSurvives) {
    BakedRoom room = makeExampleRoom({.lines = 0});
    auto& irradiance = room.field.atlas.irradiance;
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        irradiance[i] = std::exp2(static_cast<float>(i % 120) - 60) * Vec3(1, 0, 1.9999f);
    const BakedRoom read = throughFile(room);
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        ASSERT_LE(test::largestRelativeError(read.field.atlas.irradiance[i], irradiance[i]),
                  1.0 / 4096);
}

TEST(FieldFile, RadianceAndDistanceAreRoundedWithinTheirBounds) {
    const BakedRoom room = makeExampleRoom({.lines = 33, .cells = 64});
    const RadianceField &expected = room.field.radiance, read = throughFile(room).field.radiance;
    ASSERT_EQ(read.elements.size(), expected.elements.size());
    glm::dvec3 sum(0), sumExpected(0);
    for (std::size_t i = 0; i < read.elements.size(); ++i) {
        const RadianceElement &a = read.elements[i], &b = expected.elements[i];
        ASSERT_EQ(a.distance == 0, b.distance == 0);
        if (b.distance == 0) continue;
        ASSERT_LE(std::abs(a.distance - b.distance), 16);
        const Vec3 x = unpackRgb9e5(a.rgb9e5()), y = unpackRgb9e5(b.rgb9e5());
        for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(x[c] - y[c]), maxComponent(y) / 256) << i;
        sum += glm::dvec3(x);
        sumExpected += glm::dvec3(y);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / sumExpected[c], 1, 5e-4);
}

TEST(FieldFile, KeepsTheLayoutOfTheRadianceField) {
    const RadianceField expected = makeExampleRoom().field.radiance;
    const RadianceField read = throughFile(makeExampleRoom()).field.radiance;
    EXPECT_EQ(read.lines, expected.lines);
    EXPECT_EQ(read.cells, expected.cells);
    EXPECT_EQ(read.tileSize, expected.tileSize);
    EXPECT_EQ(read.maxDistance, expected.maxDistance);
    EXPECT_EQ(read.firstRow, expected.firstRow);
    ASSERT_EQ(read.rows.size(), expected.rows.size());
    for (std::size_t i = 0; i < read.rows.size(); ++i) {
        EXPECT_EQ(read.rows[i].chart, expected.rows[i].chart);
        EXPECT_EQ(read.rows[i].tileX, expected.rows[i].tileX);
        EXPECT_EQ(read.rows[i].tileY, expected.rows[i].tileY);
        EXPECT_EQ(read.rows[i].tilesWide, expected.rows[i].tilesWide);
        EXPECT_EQ(read.rows[i].firstElement, expected.rows[i].firstElement);
    }
}

TEST(FieldFile, ExtremeRadianceSurvives) {
    BakedRoom room = makeExampleRoom();
    std::uint32_t bits = 1;
    for (RadianceElement& e : room.field.radiance.elements) {
        bits = bits * 1664525 + 1013904223;
        e = {packRgb9e5(unpackRgb9e5(bits)), static_cast<std::uint16_t>(bits >> 7 | 1)};
    }
    const RadianceField read = throughFile(room).field.radiance;
    for (std::size_t i = 0; i < read.elements.size(); ++i) {
        const RadianceElement &a = read.elements[i], &b = room.field.radiance.elements[i];
        ASSERT_LE(std::abs(a.distance - b.distance), 16);
        const Vec3 x = unpackRgb9e5(a.rgb9e5()), y = unpackRgb9e5(b.rgb9e5());
        for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(x[c] - y[c]), maxComponent(y) / 256) << i;
    }
}

TEST(FieldFile, RowsInAnyPlaceAreReadOneAfterTheOther) {
    const BakedRoom room = makeExampleRoom();
    BakedRoom shuffled = room;
    RadianceField& radiance = shuffled.field.radiance;
    radiance.elements.clear();
    for (std::size_t r = radiance.rows.size(); r-- > 0;) {
        TileRow& row = radiance.rows[r];
        const auto first =
            room.field.radiance.elements.begin() + static_cast<std::ptrdiff_t>(row.firstElement);
        radiance.elements.resize(radiance.elements.size() + 5);
        row.firstElement = radiance.elements.size();
        radiance.elements.insert(radiance.elements.end(), first, first + 64 * row.tilesWide);
    }
    const BakedRoom a = throughFile(room), b = throughFile(shuffled);
    ASSERT_EQ(a.field.radiance.elements.size(), b.field.radiance.elements.size());
    for (std::size_t i = 0; i < a.field.radiance.elements.size(); ++i) {
        ASSERT_EQ(a.field.radiance.elements[i].rgb9e5(), b.field.radiance.elements[i].rgb9e5());
        ASSERT_EQ(a.field.radiance.elements[i].distance, b.field.radiance.elements[i].distance);
    }
}

TEST(FieldFile, WhatWasReadIsWrittenAgainByteForByte) {
    const TempFolder folder;
    BakedRoom room = makeExampleRoom({.lines = 33, .cells = 64});
    std::uint32_t bits = 1;
    for (std::size_t i = 0; i < room.field.radiance.elements.size(); i += 2) {
        RadianceElement& e = room.field.radiance.elements[i];
        bits = bits * 1664525 + 1013904223;
        e = {bits, e.distance};
    }
    writeField(folder.file("a.vlf"), room);
    writeField(folder.file("b.vlf"), readField(folder.file("a.vlf")));
    EXPECT_EQ(readFile(folder.file("a.vlf")), readFile(folder.file("b.vlf")));
}

TEST(FieldFile, IsTheSameForAnyNumberOfThreads) {
    const TempFolder folder;
    const BakedRoom room = makeExampleRoom({.texelsPerMetre = 60, .lines = 33, .cells = 128});
    std::vector<std::vector<std::uint8_t>> files;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        writeField(folder.file("a.vlf"), room);
        files.push_back(readFile(folder.file("a.vlf")));
    }
    EXPECT_EQ(files[0], files[1]);
    EXPECT_EQ(files[0], files[2]);
}

double storedBytes(const FieldFileInfo& info, const std::string& name) {
    for (const ChunkInfo& chunk : info.chunks)
        if (chunk.name == name) return static_cast<double>(chunk.storedBytes);
    return NAN;
}

TEST(FieldFile, StaysWithinItsBudgetOfBytes) {
    const TempFolder folder;
    const BakedRoom room = makeExampleRoom({.texelsPerMetre = 50, .lines = 33, .cells = 256});
    writeField(folder.file("a.vlf"), room);
    const FieldFileInfo info = readFieldInfo(folder.file("a.vlf"));
    EXPECT_LE(storedBytes(info, "irradiance") / static_cast<double>(info.counts.texels()), 2.0);
    EXPECT_LE(storedBytes(info, "radiance") / static_cast<double>(info.counts.radiance.filled), 1.5);
}

TEST(FieldFile, ElementsThatAreNotTheirChartsCostNextToNothing) {
    const TempFolder folder;
    BakedRoom room = makeExampleRoom({.lines = 33, .cells = 256});
    for (RadianceElement& e : room.field.radiance.elements) e.distance = 0;
    writeField(folder.file("a.vlf"), room);
    EXPECT_LE(storedBytes(readFieldInfo(folder.file("a.vlf")), "radiance"),
              0.01 * static_cast<double>(room.field.radiance.elements.size()));
}

TEST(FieldFile, InfoTellsWhatIsInside) {
    const TempFolder folder;
    const BakedRoom room = makeExampleRoom();
    writeField(folder.file("a.vlf"), room);
    const FieldFileInfo info = readFieldInfo(folder.file("a.vlf"));
    EXPECT_EQ(info.fileBytes, readFile(folder.file("a.vlf")).size());
    EXPECT_EQ(info.counts.triangles, room.scene.triangles.size());
    EXPECT_EQ(info.counts.charts, room.field.charts.size());
    EXPECT_EQ(info.counts.texels(), room.field.atlas.irradiance.size());
    EXPECT_EQ(info.counts.radiance.elements, room.field.radiance.elements.size());
    EXPECT_GT(info.counts.radiance.filled, 0u);
    EXPECT_LT(info.counts.radiance.filled, info.counts.radiance.elements);
    EXPECT_EQ(info.record.preset, "standard");
    ASSERT_EQ(info.cameras.size(), 2u);
    EXPECT_EQ(info.cameras[1].name, "door");
    std::uint64_t stored = 0;
    for (const ChunkInfo& chunk : info.chunks) stored += chunk.storedBytes;
    EXPECT_LT(stored, info.fileBytes);
    EXPECT_GT(stored + 4096, info.fileBytes);
}

TEST(FieldFile, AnEmptySceneAndADarkOneSurvive) {
    EXPECT_TRUE(throughFile(BakedRoom{}).scene.triangles.empty());
    BakedRoom dark = makeExampleRoom({.texelsPerMetre = 60, .lines = 0, .textureSide = 600});
    for (Vec3& e : dark.field.atlas.irradiance) e = Vec3(0);
    for (auto& byte : dark.scene.textures[0].srgb8) byte = 0;
    EXPECT_EQ(throughFile(dark).field.atlas.irradiance, dark.field.atlas.irradiance);
}

struct Fault {
    const char* chunk;
    std::function<void(BakedRoom&)> apply;
};

TEST(FieldFile, RoomsThatWouldLeadOutOfBoundsAreNotWritten) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Fault> faults = {
        {"triangles", [](BakedRoom& r) { r.scene.triangles[3].vertex[1] = 24; }},
        {"triangles", [](BakedRoom& r) { r.scene.triangles[3].material = 6; }},
        {"meshes", [](BakedRoom& r) { r.scene.meshes[1].triangleCount = 0xffffffff; }},
        {"positions", [=](BakedRoom& r) { r.scene.positions[2].y = nan; }},
        {"normals", [](BakedRoom& r) { r.scene.normals.pop_back(); }},
        {"uvs", [](BakedRoom& r) { r.scene.uvs.emplace_back(); }},
        {"materials", [](BakedRoom& r) { r.scene.materials[0].mirrorTexture = 2; }},
        {"materials", [](BakedRoom& r) { r.scene.materials[0].diffuseTexture = -2; }},
        {"materials", [=](BakedRoom& r) { r.scene.materials[0].emission.x = -1; }},
        {"textures", [](BakedRoom& r) { r.scene.textures[0].width = 0; }},
        {"textures", [](BakedRoom& r) { r.scene.textures[0].srgb8.pop_back(); }},
        {"textures", [](BakedRoom& r) { r.scene.textures[1].wrapU = static_cast<Wrap>(3); }},
        {"pixels.linear", [=](BakedRoom& r) { r.scene.textures[1].linear[0].x = nan; }},
        {"cameras", [](BakedRoom& r) { r.scene.cameras[0].verticalFov = 180; }},
        {"cameras", [](BakedRoom& r) { r.scene.cameras[0].look = r.scene.cameras[0].eye; }},
        {"bake", [=](BakedRoom& r) { r.field.record.energy.absorbed.y = nan; }},
        {"bake", [=](BakedRoom& r) { r.field.record.residual = nan; }},
        {"charts", [](BakedRoom& r) { r.field.charts[0].x = 0; }},
        {"charts", [](BakedRoom& r) { ++r.field.charts[5].height; }},
        {"charts", [](BakedRoom& r) { r.field.charts[1].width = 0xffffffff; }},
        {"charts", [](BakedRoom& r) { r.field.charts[1].material = 6; }},
        {"charts", [=](BakedRoom& r) { r.field.charts[1].vOffset = nan; }},
        {"triangle charts", [](BakedRoom& r) { r.field.triangleCharts[1].back = 6; }},
        {"triangle charts", [](BakedRoom& r) { r.field.triangleCharts.pop_back(); }},
        {"irradiance", [=](BakedRoom& r) { r.field.atlas.irradiance[9].z = nan; }},
        {"irradiance", [](BakedRoom& r) { r.field.atlas.irradiance.pop_back(); }},
        {"summary", [](BakedRoom& r) { r.field.radiance.lines = 10; }},
        {"summary", [](BakedRoom& r) { r.field.radiance.tileSize = 0; }},
        {"summary", [=](BakedRoom& r) { r.field.radiance.maxDistance = nan; }},
        {"subfields", [](BakedRoom& r) { r.field.radiance.firstRow.back() = 0; }},
        {"subfields", [](BakedRoom& r) { r.field.radiance.firstRow.pop_back(); }},
        {"tile rows", [](BakedRoom& r) { r.field.radiance.rows[0].chart = 6; }},
        {"tile rows", [](BakedRoom& r) { r.field.radiance.rows[0].tilesWide = 60000; }},
        {"tile rows", [](BakedRoom& r) { r.field.radiance.rows[1].tileY += 1; }},
        {"tile rows", [](BakedRoom& r) { r.field.radiance.rows[0].firstElement = ~0ull; }},
        {"tile rows", [](BakedRoom& r) { r.field.radiance.elements.pop_back(); }},
    };
    const TempFolder folder;
    const BakedRoom good = makeExampleRoom();
    for (std::size_t i = 0; i < faults.size(); ++i) {
        BakedRoom room = good;
        faults[i].apply(room);
        try {
            writeField(folder.file("a.vlf"), room);
            ADD_FAILURE() << "fault " << i << " in " << faults[i].chunk << " was written";
        } catch (const InputError& e) {
            const std::string place = std::string("chunk ") + faults[i].chunk + ":";
            EXPECT_NE(std::string(e.what()).find(place), std::string::npos) << i << e.what();
        }
    }
    EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(FieldFile, AFolderThatIsNotThereIsAFileError) {
    const TempFolder folder;
    EXPECT_THROW(writeField(folder.file("none/a.vlf"), makeExampleRoom()), FileError);
    EXPECT_THROW(readField(folder.file("none/a.vlf")), FileError);
    test::putBytes(folder.file("file"), {1});
    EXPECT_THROW(writeField(folder.file("file/a.vlf"), makeExampleRoom()), FileError);
}

/// Stands for a full disk: no file may grow beyond `bytes` while it lives.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &saved_);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, saved_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &saved_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit saved_{};
    void (*handler_)(int) = SIG_DFL;
};

TEST(FieldFile, WhenTheDiskIsFullTheOldFileStaysAndNothingElse) {
    const TempFolder folder;
    writeField(folder.file("a.vlf"), makeExampleRoom());
    const std::vector<std::uint8_t> before = readFile(folder.file("a.vlf"));
    {
        const FileSizeLimit limit(1000);
        EXPECT_THROW(writeField(folder.file("a.vlf"), makeExampleRoom({.cells = 48})), FileError);
    }
    EXPECT_EQ(readFile(folder.file("a.vlf")), before);
    EXPECT_EQ(folder.fileCount(), 1u);
}

}  // namespace
}  // namespace vlf
