// gather_rival SCENE -o F.vlf --rays N: a bake whose bounces are a gather with rays of Embree.
//
// Charts, direct light and the atlas are those of `vlf bake`, so that the two differ in the bounces
// alone; how the coarse ones end and how the noise of the last is smoothed is the same, too. The
// field can be measured like any other: `vlf reference SCENE --irradiance F.vlf`.
// bench/gather_table.py makes the table of docs/benchmarks.md.

#include "texel_gather.h"

#include "vlf/base/parallel.h"
#include "vlf/io/field_file.h"
#include "vlf/propagate/convergence.h"
#include "vlf/propagate/smooth_indirect.h"
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
    int coarseRays = 8;
    int settling = 4;
    int threads = 0;
};

/// L = ρE/π of every texel. Texels whose light is not known are no samples unless they are black.
TexelBuffer emit(const BakeState& state) {
    const Unwrap& unwrap = state.unwrap;
    TexelBuffer radiance(unwrap.atlasSize());
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i)
        radiance.set(unwrap.texels[i], state.reflectance[i] * state.irradiance[i] / kPi, 1);
    for (const auto& [texel, chart] : unwrap.divided)
        if (maxComponent(state.scene.materials[unwrap.charts[chart].material].diffuse) <= 0)
            radiance.set(texel, Vec3(0), 1);
    for (const auto& [texel, proxy] : unwrap.proxies) radiance.set(texel, radiance.rgb(proxy), 1);
    return radiance;
}

/// A bake by gathering.
class GatherBake {
  public:
    GatherBake(BakeState& state, const Options& options)
        : state_(state), options_(options), gather_(state) {}

    /// As propagate(): coarse bounces to convergence, the mean of a few more, a fine one.
    void propagate() {
        Convergence convergence(state_);
        while (!convergence.reached(state_.params.maxBounces, state_.params.tolerance)) {
            bounce(options_.coarseRays, 1);
            convergence.update();
        }
        state_.report.residual = convergence.residualAfter(state_.params.settlingSweeps);
        if (state_.params.settlingSweeps > 0) settle();
        bounce(options_.rays, kParts);
    }

  private:
    static constexpr int kParts = 4;  // of the last bounce: how they differ tells the noise

    void settle() {
        std::vector<Vec3> sum(state_.irradiance.size(), Vec3(0));
        for (int i = 0; i < 2 * state_.params.settlingSweeps; ++i) {
            bounce(options_.coarseRays, 1);
            if (i < state_.params.settlingSweeps) continue;
            for (std::size_t t = 0; t < sum.size(); ++t) sum[t] += state_.irradiance[t];
        }
        for (std::size_t t = 0; t < sum.size(); ++t)
            state_.irradiance[t] = sum[t] / static_cast<float>(state_.params.settlingSweeps);
    }

    /// E = E_direct + π ΣL / n, smoothed where there are parts.
    void bounce(int rays, int parts) {
        const TexelBuffer radiance = emit(state_);
        std::vector<TexelBuffer> gathered(parts, TexelBuffer(state_.unwrap.atlasSize()));
        for (int part = 0; part < parts; ++part)
            gather_.gather(radiance, rays / parts, ++seed_, gathered[part]);
        ++state_.report.sweeps;
        deposit(gathered);
    }

    void deposit(std::vector<TexelBuffer>& parts) {
        TexelBuffer gathered = sumInOrder(parts);
        smoothIndirect(state_.unwrap, parts, gathered);
        for (std::size_t i = 0; i < state_.unwrap.texels.size(); ++i) {
            const std::uint32_t texel = state_.unwrap.texels[i];
            const float samples = gathered.weight(texel);
            if (samples <= 0) continue;
            state_.reached[i] = 1;
            state_.irradiance[i] = state_.directIrradiance[i] + kPi * gathered.rgb(texel) / samples;
        }
    }

    BakeState& state_;
    const Options& options_;
    bench::TexelGather gather_;
    std::uint64_t seed_ = 0;
};

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
    params.settlingSweeps = options.settling;
    Progress progress;
    BakeState state = makeState(room.scene, params, progress);
    const std::clock_t start = std::clock();
    GatherBake(state, options).propagate();
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
    app.add_option("--settling", options.settling, "Mean of so many bounces into the last")
        ->check(CLI::Range(0, 1000))
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
