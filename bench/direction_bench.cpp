// Nanoseconds per lookup in a direction set: flat in the number of lines.

#include "vlf/field/direction_set.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace vlf;

std::vector<Vec3> randomDirections() {
    RandomStream random(1, 0);
    std::vector<Vec3> directions(4096);
    for (Vec3& d : directions) d = sampleUniformSphere(random.next2());
    return directions;
}

template <class Lookup>
void lookUp(benchmark::State& state, Lookup lookup) {
    const DirectionSet set(static_cast<int>(state.range(0)));
    const std::vector<Vec3> directions = randomDirections();
    for (auto _ : state)
        for (const Vec3& d : directions) benchmark::DoNotOptimize(lookup(set, d));
    state.counters["per lookup"] =
        benchmark::Counter(static_cast<double>(state.iterations() * directions.size()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void nearest(benchmark::State& state) {
    lookUp(state, [](const DirectionSet& set, const Vec3& d) { return set.nearest(d); });
}
BENCHMARK(nearest)->Arg(129)->Arg(513)->Arg(2049)->Arg(8193);

void triple(benchmark::State& state) {
    lookUp(state, [](const DirectionSet& set, const Vec3& d) { return set.triple(d); });
}
BENCHMARK(triple)->Arg(129)->Arg(513)->Arg(2049)->Arg(8193);

}  // namespace
