// Field files: bytes per texel and element, and how fast a file is written and read.
//
//     io_bench [FIELD.vlf ...]
//
// Of made-up rooms, and of field files. Bytes per second are those of memory filled.

#include "unit/io/example_room.h"

#include "vlf/io/field_file.h"

#include <filesystem>

#include <benchmark/benchmark.h>

namespace {

using vlf::BakedRoom;

/// Irradiance alone, 6 million texels, or radiance alone, 9 million elements of tiles of m x m.
BakedRoom makeRoom(int tileSize) {
    if (tileSize == 0)
        return vlf::test::makeExampleRoom({.texelsPerMetre = 200, .lines = 0, .textureSide = 1024});
    return vlf::test::makeExampleRoom(
        {.texelsPerMetre = 50, .lines = 513, .cells = 256, .tileSize = tileSize});
}

std::string filePath(int tileSize) {
    const auto folder = std::filesystem::temp_directory_path();
    return (folder / ("vlf_io_bench_" + std::to_string(tileSize) + ".vlf")).string();
}

double memoryBytes(const vlf::FieldFileInfo& info) {
    double sum = 0;
    for (const vlf::ChunkInfo& chunk : info.chunks) sum += static_cast<double>(chunk.memoryBytes);
    return sum;
}

void reportSizes(benchmark::State& state, const vlf::FieldFileInfo& info) {
    for (const vlf::ChunkInfo& chunk : info.chunks) {
        const auto stored = static_cast<double>(chunk.storedBytes);
        if (chunk.name == "irradiance")
            state.counters["B/texel"] = stored / static_cast<double>(info.counts.texels());
        if (chunk.name == "radiance" && info.counts.radiance.filled > 0)
            state.counters["B/element"] = stored / static_cast<double>(info.counts.radiance.filled);
        if (chunk.name == "pixels.srgb8" && chunk.memoryBytes > 0)
            state.counters["B/pixel"] = 4 * stored / static_cast<double>(chunk.memoryBytes);
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * memoryBytes(info)));
}

void write(benchmark::State& state, const BakedRoom& room, const std::string& path) {
    for (auto _ : state) vlf::writeField(path, room);
    reportSizes(state, vlf::readFieldInfo(path));
    std::filesystem::remove(path);
}

void read(benchmark::State& state, const std::string& path) {
    for (auto _ : state) benchmark::DoNotOptimize(vlf::readField(path));
    reportSizes(state, vlf::readFieldInfo(path));
}

void writeRoom(benchmark::State& state) {
    const int tileSize = static_cast<int>(state.range(0));
    write(state, makeRoom(tileSize), filePath(tileSize));
}

void readRoom(benchmark::State& state) {
    const int tileSize = static_cast<int>(state.range(0));
    const std::string path = filePath(tileSize);
    vlf::writeField(path, makeRoom(tileSize));
    read(state, path);
    std::filesystem::remove(path);
}

void measure(benchmark::internal::Benchmark* benchmark) {
    benchmark->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

const std::vector<std::int64_t> kTileSizes = {0, 8, 16};
BENCHMARK(writeRoom)->ArgsProduct({kTileSizes})->Apply(measure);
BENCHMARK(readRoom)->ArgsProduct({kTileSizes})->Apply(measure);

void addFile(const std::string& path) {
    measure(benchmark::RegisterBenchmark(
        ("write/" + path).c_str(),
        [path](benchmark::State& state) { write(state, vlf::readField(path), filePath(0)); }));
    measure(benchmark::RegisterBenchmark(("read/" + path).c_str(),
                                         [path](benchmark::State& state) { read(state, path); }));
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    for (int i = 1; i < argc; ++i) addFile(argv[i]);
    benchmark::RunSpecifiedBenchmarks();
}
