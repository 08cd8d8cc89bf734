// gather_rival SCENE -o F.vlf --rays N: a bake whose bounces are a gather with rays of Embree.
//
// Charts, direct light and the atlas are those of `vlf bake`, so that the two differ in the
// bounces alone; the rule by which the coarse bounces end is the same, too. The field can be
// measured like any other: `vlf reference SCENE --irradiance F.vlf`. bench/gather_table.py makes
// the table of docs/benchmarks.md.

#include "texel_gather.h"

#include "vlf/base/parallel.h"
#include "vlf/io/field_file.h"
#include "vlf/propagate/convergence.h"
#include "vlf/scene/import/import.h"
#include "vlf/scene/scene_hash.h"

#include <ctime>
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace {

using namespace vlf;

struct Options {
    std::string scene, output, json, preset = "standard";
    int rays = 256;
    int coarseRays = 16;
    int threads = 0;
};

/// L = ρE/π of every texel; black within solids.
TexelBuffer emit(const BakeState& state) {
    const Unwrap& unwrap = state.unwrap;
    TexelBuffer radiance(unwrap.atlasSize());
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i)
        radiance.set(unwrap.texels[i], state.reflectance[i] * state.irradiance[i] / kPi, 1);
    for (const auto& [texel, proxy] : unwrap.proxies) radiance.set(texel, radiance.rgb(proxy), 1);
    return radiance;
}

/// One bounce: E = E_direct + π ΣL / n.
void gatherOnce(BakeState& state, const bench::TexelGather& gather, int rays) {
    const auto seed = static_cast<std::uint64_t>(++state.report.sweeps);
    const TexelBuffer gathered = gather.gather(emit(state), rays, seed);
    for (std::size_t i = 0; i < state.unwrap.texels.size(); ++i) {
        const std::uint32_t texel = state.unwrap.texels[i];
        if (gathered.weight(texel) <= 0) continue;
        state.reached[i] = 1;
        state.irradiance[i] =
            state.directIrradiance[i] + kPi * gathered.rgb(texel) / gathered.weight(texel);
    }
}

void bounce(BakeState& state, const Options& options) {
    const bench::TexelGather gather(state);
    Convergence convergence(state);
    while (!convergence.reached(state.params.maxBounces, state.params.tolerance)) {
        gatherOnce(state, gather, options.coarseRays);
        convergence.update(state);
    }
    state.report.residual = convergence.residual();
    gatherOnce(state, gather, options.rays);
}

nlohmann::ordered_json toJson(const Options& options, const BakeReport& report) {
    nlohmann::ordered_json stages = nlohmann::ordered_json::array();
    for (const BakeReport::Stage& s : report.stages)
        stages.push_back({{"name", s.name}, {"seconds", s.seconds}, {"cpuSeconds", s.cpuSeconds}});
    return {{"scene", options.scene},   {"rays", options.rays},        {"texels", report.texels},
            {"bounces", report.sweeps}, {"residual", report.residual}, {"stages", stages}};
}

void run(const Options& options) {
    const ThreadLimit limit(options.threads);
    ImportReport imported;
    BakedRoom room;
    room.scene = importScene({options.scene}, imported);
    BakeParams params = presetParams(options.preset);
    params.radianceDirections = 0;
    Progress progress;
    BakeState state = makeState(room.scene, params, progress);
    const std::clock_t start = std::clock();
    bounce(state, options);
    state.report.stages.push_back(
        {"bounces", 0, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC});
    room.field = finish(state, progress);
    room.field.record.sceneHash = sceneHash(room.scene);
    writeField(options.output, room);
    if (!options.json.empty())
        std::ofstream(options.json) << toJson(options, state.report).dump(2) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("A bake by gathering with rays, to compare the bundles with");
    app.add_option("scene", options.scene, "Scene file")->required();
    app.add_option("-o,--output", options.output, "Field file to write (.vlf)")->required();
    app.add_option("--rays", options.rays, "Rays per texel of the last bounce")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    app.add_option("--coarse-rays", options.coarseRays, "Of the bounces before it")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    app.add_option("--preset", options.preset, "draft, standard or high")->capture_default_str();
    app.add_option("--threads", options.threads, "0: one per core");
    app.add_option("--json", options.json, "Write a report of times");
    CLI11_PARSE(app, argc, argv);
    try {
        run(options);
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << "\n";
        return 1;
    }
}
