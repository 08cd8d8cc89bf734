// Exchanges of radiance per second of the bundle sweeps, by triangle count and instruction set.

#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/bundle_sweep.h"
#include "vlf/scene/generate/generate.h"

#include <array>
#include <map>
#include <memory>

#include <benchmark/benchmark.h>

namespace {

constexpr int kCells = 512;

struct Room {
    vlf::Scene scene;
    std::unique_ptr<vlf::BakeState> state;
};

/// The room with a statue of so many triangles; 0: the Cornell box.
Room& room(int triangles) {
    static std::map<int, Room> rooms;
    Room& r = rooms[triangles];
    if (!r.state) {
        r.scene = triangles == 0 ? vlf::generateScene("cornell")
                                 : vlf::generateScene("gallery", {.triangles = triangles});
        vlf::Progress progress;
        vlf::BakeParams params;
        params.directSamples = 1;
        r.state = std::make_unique<vlf::BakeState>(vlf::makeState(r.scene, params, progress));
    }
    return r;
}

/// All lines of a small direction set, on all threads, each with buffers of its own.
void sweepAll(benchmark::State& bench, const std::string& instructionSet) {
    const std::string before = vlf::currentInstructionSet();
    vlf::useInstructionSet(instructionSet);
    const vlf::BakeState& state = *room(static_cast<int>(bench.range(0))).state;
    const vlf::DirectionSet directions(129);
    const auto threads = static_cast<std::size_t>(vlf::threadCount());
    const vlf::TexelBuffer radiance(state.unwrap.atlasSize());
    std::vector<vlf::TexelBuffer> gathered(threads, radiance);
    std::vector<std::uint64_t> exchanges(threads, 0);
    for (auto _ : bench)
        vlf::parallelFor(threads, [&](std::size_t t) {
            vlf::SweepScratch scratch;
            std::vector<vlf::MirrorSight> sights;
            for (auto i = static_cast<std::uint32_t>(t); i < 129; i += threads)
                exchanges[t] += vlf::sweepBundle(
                    state.faces, vlf::makeSubfield(state.frame, directions.direction(i), kCells),
                    radiance, gathered[t], sights, scratch);
        });
    double total = 0;
    for (const std::uint64_t n : exchanges) total += static_cast<double>(n);
    bench.counters["triangles"] = static_cast<double>(state.scene.triangles.size());
    bench.counters["exchanges/s"] = benchmark::Counter(total, benchmark::Counter::kIsRate);
    vlf::useInstructionSet(before);
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::string& name : vlf::availableInstructionSets())
        benchmark::RegisterBenchmark(("sweep/" + name).c_str(),
                                     [name](benchmark::State& b) { sweepAll(b, name); })
            ->Arg(0)
            ->Arg(10000)
            ->Arg(200000)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
