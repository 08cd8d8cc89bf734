#include "vlf/propagate/bake.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/math/microfacet.h"
#include "vlf/propagate/entering_light.h"
#include "vlf/propagate/fill_atlas.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <map>
#include <utility>

namespace vlf {

namespace {

/// Announces a stage and notes how long it took.
template <class Work>
auto timed(BakeReport& report, Progress& progress, const std::string& name, Work work) {
    progress.check();
    progress.stage(name);
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpuStart = std::clock();
    const auto note = [&] {
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
        const double cpu = static_cast<double>(std::clock() - cpuStart) / CLOCKS_PER_SEC;
        report.stages.push_back({name, wall.count(), cpu});
    };
    if constexpr (std::is_void_v<decltype(work())>) {
        work();
        note();
    } else {
        auto result = work();
        note();
        return result;
    }
}

FieldFrame frameOf(const Scene& scene) {
    const Sphere sphere = boundingSphere(scene);
    return {sphere.centre, sphere.radius};
}

/// What a side of glass takes of diffuse light. A solid's loss at both surfaces is put down to its
/// outside, as if all light that enters left it by another.
Vec3 glassAbsorptance(const Material& m, bool front) {
    if (!m.isGlass() || (!m.thin && !front)) return Vec3(0);
    const float reflected = meanReflectance([&](float cosine) {
        return m.thin ? paneReflectance(cosine, m.ior) : fresnelReflectance(cosine, m.ior);
    });
    const Vec3 passed = m.thin ? m.transmission : m.transmission * m.transmission;
    return (1 - reflected) * (Vec3(1) - passed);
}

/// Mean reflectances over each texel's points. What a rough mirror takes of diffuse light counts as
/// absorbed.
void findReflectances(BakeState& state) {
    const Unwrap& u = state.unwrap;
    std::vector<float> mirrorAlbedo;
    for (const Material& m : state.scene.materials)
        mirrorAlbedo.push_back(m.isGlossy() ? ggxMeanAlbedo(m.roughness) : 1);
    std::vector<std::array<Vec3, 2>> glass;
    for (const Material& m : state.scene.materials)
        glass.push_back({glassAbsorptance(m, true), glassAbsorptance(m, false)});
    state.reflectance.resize(u.texels.size());
    state.absorptance.resize(u.texels.size());
    parallelFor(u.texels.size(), 512, [&](std::size_t i) {
        const Material& material = state.scene.materials[u.charts[u.texelChart[i]].material];
        if (material.isGlass()) {
            const bool front =
                u.triangleCharts[u.points.of(i)[0].triangle].front == u.texelChart[i];
            state.reflectance[i] = Vec3(0);
            state.absorptance[i] = glass[u.charts[u.texelChart[i]].material][front ? 0 : 1];
            return;
        }
        const MeanReflectance mean = meanReflectance(state.scene, u.points.of(i));
        state.reflectance[i] = mean.diffuse;
        const float albedo = mirrorAlbedo[u.charts[u.texelChart[i]].material];
        state.absorptance[i] = glm::max(Vec3(0), Vec3(1) - (mean.diffuse + albedo * mean.mirror));
    });
}

EnergyReport energyBalance(const BakeState& state) {
    glm::dvec3 emitted(0), absorbed(0), reflected(0);
    for (const Light& light : state.sources.lights)
        emitted += glm::dvec3(light.radiance) * static_cast<double>(kPi * light.area);
    emitted += glm::dvec3(emittedFlux(state.scene, state.rays, state.sources.sky.get()));
    for (std::size_t i = 0; i < state.irradiance.size(); ++i) {
        const glm::dvec3 flux =
            glm::dvec3(state.irradiance[i]) * static_cast<double>(state.unwrap.texelArea(i));
        absorbed += flux * glm::dvec3(state.absorptance[i]);
        reflected += flux * glm::dvec3(state.reflectance[i]);
    }
    const glm::dvec3 unshot = reflected * state.report.residual;
    return {Vec3(emitted), Vec3(absorbed), Vec3(unshot), Vec3(emitted - absorbed - unshot)};
}

void checkParams(const BakeParams& p, std::size_t triangles) {
    if (p.cells < 16 || p.cells > 8192)
        throw InputError("cells must lie between 16 and 8192, not " + std::to_string(p.cells));
    if (p.texelSize < 0) throw InputError("the texel size must be positive");
    if (p.error < 0 || p.seconds < 0 || p.refinements < 0)
        throw InputError("what ends the refinement must be positive");
    if (refines(p) && p.maxBounces > 0)
        throw InputError(
            "a refinement (--error, --seconds, --refinements) needs light at rest: "
            "leave the bounces to it (--bounces auto)");
    if (!p.pieces.empty() && p.pieces.size() != triangles)
        throw InputError("the pieces are those of another scene");
    if (p.directSamples < 1) throw InputError("direct light needs at least one sample");
}

std::vector<BakeReport::TexelScale> countTexels(const Unwrap& u, const TexelPieces& pieces) {
    std::map<float, std::size_t> counts;
    for (std::size_t i = 0; i < u.texels.size(); ++i)
        ++counts[pieces.empty() ? 1 : pieces[u.points.of(i)[0].triangle].scale];
    std::vector<BakeReport::TexelScale> scales;
    for (const auto& [scale, texels] : counts) scales.push_back({scale, texels});
    return scales;
}

/// Everything before light.
void layOut(BakeState& state, Progress& progress) {
    const BakeParams& p = state.params;
    state.frame = frameOf(state.scene);
    state.unwrap = timed(state.report, progress, "charts", [&] {
        return unwrap(state.scene, state.rays,
                      {.texelSize = p.texelSize,
                       .texelBudget = p.texelBudget,
                       .seed = p.seed,
                       .pieces = p.pieces},
                      progress);
    });
    state.report.texels = state.unwrap.texels.size();
    state.report.texelScales = countTexels(state.unwrap, p.pieces);
    state.faces = makeBundleFaces(state.scene, state.unwrap, state.frame);
    state.sources = findLightSources(state.scene, state.unwrap);
    state.bentTexels = findBentTexels(state.scene, state.unwrap);
    findReflectances(state);
    checkSolution(state);
}

void lightDirectly(BakeState& state, Progress& progress, const BakeObserver& observe) {
    const DirectLightParams params{state.params.directSamples, state.params.seed};
    timed(state.report, progress, "direct light", [&] {
        while (!findDirectLight(state.scene, state.rays, state.unwrap, state.sources, params,
                                state.direct, progress))
            observe(state);
    });
    for (const DirectEstimate& e : state.direct.estimates) {
        state.directIrradiance.push_back(e.value);
        state.directVariance.push_back(e.squareError());
    }
    if (!refines(state.params)) state.direct = {};
    state.irradiance = state.directIrradiance;
    state.reached.assign(state.irradiance.size(), 0);
    state.stage = BakeStage::directLight;
}

/// The field after zero bounces, or what the state goes on from.
void begin(BakeState& state, Progress& progress, const BakeObserver& observe) {
    checkParams(state.params, state.scene.triangles.size());
    layOut(state, progress);
    observe(state);
    if (state.stage > BakeStage::charts) return;
    lightDirectly(state, progress, observe);
    observe(state);
}

/// Completes one of the radiance fields.
void fill(BakeState& state, const LightField& field, const char* stage,
          const RadianceParams& params, PartialRadiance& partial, Progress& progress,
          const BakeObserver& observe) {
    const bool any = std::any_of(field.charts.begin(), field.charts.end(), [&](const Chart& chart) {
        return state.scene.materials[chart.material].isSpecular(params.kind);
    });
    if (params.lines == 0 || !any) return;
    timed(state.report, progress, stage, [&] {
        while (!fillRadiance(state.scene, state.rays, field, params, partial, progress))
            observe(state);
    });
}

void addRadianceFields(BakeState& state, LightField& field, Progress& progress,
                       const BakeObserver& observe) {
    const auto [perfect, rough] = radianceParams(state.params);
    fill(state, field, "radiance field", perfect, state.radiance, progress, observe);
    fill(state, field, "gloss", rough, state.gloss, progress, observe);
    field.radiance = std::move(state.radiance.field);
    field.gloss = std::move(state.gloss.field);
    state.radiance = {};
    state.gloss = {};
    state.report.radianceElements = field.radiance.elements.size() + field.gloss.elements.size();
}

}  // namespace

BakeParams presetParams(const std::string& name) {
    BakeParams p;
    p.preset = name;
    if (name == "draft") {
        p.directions = 513;
        p.cells = 128;
        p.texelBudget = 20000;
        p.directSamples = 2;
        p.tolerance = 5e-3;
        p.settlingSweeps = 1;
        p.radianceDirections = 513;
        p.radianceCells = 128;
        p.glossDirections = 129;
        p.glossCells = 64;
        p.gloss = {16, 4};
    } else if (name == "high") {
        p.directions = 8193;
        p.cells = 512;
        p.texelBudget = 150000;
        p.directSamples = 32;
        p.tolerance = 3e-4;
        p.coarseDirections = 513;
        p.settlingSweeps = 6;
        p.radianceCells = 512;
        p.glossDirections = 2049;
        p.glossCells = 256;
    } else if (name != "standard") {
        throw InputError("unknown preset '" + name + "': choose draft, standard or high");
    }
    return p;
}

std::array<RadianceParams, 2> radianceParams(const BakeParams& p) {
    return {{{.lines = p.radianceDirections, .cells = p.radianceCells, .tileSize = p.tileSize},
             {.lines = p.glossDirections,
              .cells = p.glossCells,
              .tileSize = p.tileSize,
              .kind = MirrorKind::rough,
              .gloss = p.gloss}}};
}

BakeState makeState(const Scene& scene, const BakeParams& params, Progress& progress,
                    const BakeObserver& observe) {
    BakeState state(scene, params);
    begin(state, progress, observe);
    return state;
}

LightField unlitField(const BakeState& state) {
    LightField field;
    field.frame = state.frame;
    field.charts = state.unwrap.charts;
    field.triangleCharts = state.unwrap.triangleCharts;
    BakeRecord& r = field.record;
    r.preset = state.params.preset;
    r.instructionSet = currentInstructionSet();
    r.seed = state.params.seed;
    r.directions = state.params.directions;
    r.cells = state.params.cells;
    r.texelSize = state.unwrap.texelSize;
    r.directSamples = state.params.directSamples;
    return field;
}

LightField finish(BakeState& state, Progress& progress, const BakeObserver& observe) {
    LightField field = unlitField(state);
    field.atlas = timed(state.report, progress, "atlas", [&] { return fillAtlas(state); });
    addRadianceFields(state, field, progress, observe);
    const ErrorEstimate estimate = estimateError(state);
    state.report.error = reportError(state, estimate);
    state.report.refinements = state.refinement.steps;
    state.report.finalLines = state.refinement.sweptLines;
    state.report.texelErrors = relativeErrors(state, estimate);
    state.report.energy = energyBalance(state);
    BakeRecord& r = field.record;
    r.radianceDirections = field.radiance.lines;
    r.radianceCells = field.radiance.cells;
    r.glossDirections = field.gloss.lines;
    r.glossCells = field.gloss.cells;
    r.tileSize = field.radiance.empty() ? field.gloss.tileSize : field.radiance.tileSize;
    if (refines(state.params))
        r.directions = nearestSet(static_cast<double>(state.refinement.sweptLines));
    r.bounces = state.report.sweeps;
    r.residual = state.report.residual;
    r.texelError = state.report.error.ofTexels();
    r.interpolatedError = state.report.error.interpolated();
    r.energy = state.report.energy;
    return field;
}

LightField bake(const Scene& scene, const BakeParams& params, Progress& progress,
                BakeReport* report, const BakeObserver& observe, BakeSolution solution) {
    BakeState state(scene, params, std::move(solution));
    try {
        begin(state, progress, observe);
        timed(state.report, progress, "bounces", [&] { propagate(state, progress, observe); });
        LightField field = finish(state, progress, observe);
        if (report) *report = state.report;
        return field;
    } catch (const Cancelled&) {
        observe(state);
        throw;
    }
}

}  // namespace vlf
