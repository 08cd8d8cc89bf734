#include "vlf/propagate/refinement.h"

#include "vlf/base/error.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/memory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace vlf {

namespace {

// Work is counted in exchanges of the bundles, of which a ray is worth this many, measured.
constexpr double kRayWork = 20;
// An element of the radiance field of perfect and of rough mirrors.
constexpr double kMirrorWork = 20, kGlossWork = 1000;

// Without an error to end at, or with a time to end in, each step aims at this part of the error.
constexpr double kStride = 0.85;

constexpr std::array<std::int32_t, 4> kLineCounts{8193, 2049, 513, 129};
constexpr double kMostLines = 1 << 20;  // more than these are no bake that anyone waits for
constexpr double kEnough = 1.1;         // sweeps aim this much lower, so as not to miss by a little
constexpr double kOvershoot = 1.3;      // lines for those that are missing
constexpr double kFewestSaved = 0.98;   // of the square error, that a pass of direct light is worth

std::string percent(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g %%", 100 * value);
    return text;
}

std::uint64_t directSamples(const BakeState& state) {
    std::uint64_t sum = 0;
    for (const DirectEstimate& e : state.direct.estimates)
        sum += static_cast<std::uint64_t>(e.samples);
    return sum;
}

/// Areas of the texels that scatter light, 0 of others.
std::vector<float> areasThatCount(const BakeState& state) {
    std::vector<float> areas(state.reflectance.size(), 0);
    for (std::size_t i = 0; i < areas.size(); ++i)
        if (maxComponent(state.reflectance[i]) > 0) areas[i] = state.unwrap.texelArea(i);
    return areas;
}

/// Σ A E² over the texels that scatter light.
double squaredLight(const BakeState& state) {
    const std::vector<float> areas = areasThatCount(state);
    double sum = 0;
    for (std::size_t i = 0; i < areas.size(); ++i)
        sum += double{areas[i]} * glm::dot(state.irradiance[i], state.irradiance[i]);
    return sum;
}

/// Samples that direct light lacks to its target.
std::uint64_t samplesMissing(const BakeState& state) {
    const std::vector<float> areas = areasThatCount(state);
    return DirectAllocation(state.unwrap, areas, state.direct.estimates,
                            state.refinement.directTarget)
        .total();
}

/// The relative error that the next steps aim at.
double aim(const BakeState& state) {
    const BakeParams& p = state.params;
    const double next = kStride * state.report.error.ofTexels();
    return p.error <= 0 || p.seconds > 0 || p.refinements > 0 ? std::max(p.error, next) : p.error;
}

[[noreturn]] void refuse(const BakeState& state, double reachable, const std::string& advice) {
    throw InputError("an error of " + percent(state.params.error) + " is out of reach: about " +
                     percent(reachable) + " is what " + advice);
}

/// The square errors left to direct and indirect light such that the work to get there is least,
/// theirs falling in proportion to the work done.
struct Share {
    double direct, indirect;
};

Share divide(double allowed, const BakeState& state) {
    const ErrorReport& e = state.report.error;
    const double direct = e.direct * e.direct, indirect = e.indirect * e.indirect;
    const double a = std::sqrt(direct * kRayWork * static_cast<double>(directSamples(state)));
    const double b = std::sqrt(indirect * static_cast<double>(state.refinement.exchanges));
    if (a + b <= 0) return {allowed, allowed};
    const Share share{allowed * a / (a + b), allowed * b / (a + b)};
    if (direct <= share.direct) return {direct, allowed - direct};
    if (indirect <= share.indirect) return {allowed - indirect, indirect};
    return share;
}

/// What is to follow, in state.refinement. Whether there is anything; throws InputError if the
/// error asked for cannot be reached.
bool plan(BakeState& state) {
    Refinement& r = state.refinement;
    if (r.steps == 0) {
        r.step = RefinementStep::sweep;
        r.lines = state.params.directions;
        return true;
    }
    const ErrorReport& e = state.report.error;
    const double error = aim(state), allowed = error * error - e.missing * e.missing;
    const bool isLast = error <= state.params.error;
    if (allowed < 0.1 * error * error) {
        if (!isLast) return false;
        refuse(state, e.missing, "light that is missing leaves: use finer texels (--texel)");
    }
    const Share share = divide(allowed, state);
    r.directTarget = share.direct * squaredLight(state);
    if (e.direct * e.direct * kFewestSaved > share.direct && samplesMissing(state) > 0) {
        r.step = RefinementStep::direct;
        return true;
    }
    const auto swept = static_cast<double>(r.sweptLines);
    const double wanted = swept * (kEnough * e.indirect * e.indirect / share.indirect - 1);
    if (wanted > kMostLines) {
        if (!isLast) return false;
        refuse(state,
               std::sqrt(e.missing * e.missing + e.indirect * e.indirect * swept / kMostLines +
                         share.direct),
               "a million lines would leave: use more rays a bundle (--cells), or ask for less");
    }
    r.step = RefinementStep::sweep;
    r.lines = nearestSet(wanted);
    return true;
}

void addDirectLight(BakeState& state, Progress& progress,
                    const std::function<void(const BakeState&)>& observe) {
    const DirectLightParams params{state.params.directSamples, state.params.seed};
    while (!refineDirectLight(state.scene, state.rays, state.unwrap, state.sources, params,
                              areasThatCount(state), state.refinement.directTarget, state.direct,
                              progress))
        observe(state);
    for (std::size_t i = 0; i < state.irradiance.size(); ++i) {
        const DirectEstimate& e = state.direct.estimates[i];
        state.irradiance[i] += e.value - state.directIrradiance[i];
        state.directIrradiance[i] = e.value;
        state.directVariance[i] = e.squareError();
    }
}

/// Takes the step that is planned or under way.
void take(BakeState& state, Progress& progress,
          const std::function<void(const BakeState&)>& observe) {
    Refinement& r = state.refinement;
    RefinementClock& clock = state.clock;
    const double start = clock.elapsed();
    if (r.step == RefinementStep::direct) {
        const std::uint64_t before = directSamples(state);
        addDirectLight(state, progress, observe);
        clock.directSeconds += clock.elapsed() - start;
        clock.samples += directSamples(state) - before;
    } else {
        const std::uint64_t before = state.report.exchanges;
        refineOnce(state, r.lines, progress, observe);
        r.exchanges += state.report.exchanges - before;
        clock.sweepSeconds += clock.elapsed() - start;
        clock.lines += static_cast<std::uint64_t>(r.lines);
        clock.exchanges += state.report.exchanges - before;
    }
    ++r.steps;
    r.step = RefinementStep::none;
    state.report.error = reportError(state, estimateError(state));
}

/// Seconds of what has to be done once the light is known.
double secondsToFinish(const BakeState& state) {
    const RefinementClock& c = state.clock;
    if (c.exchanges == 0) return 0;
    const MirrorElements elements = predictElements(state.scene, state.params);
    const double work = kMirrorWork * elements.perfect + kGlossWork * elements.rough;
    return 0.1 + work * c.sweepSeconds / static_cast<double>(c.exchanges);
}

/// Seconds of the step that is planned.
double secondsOfStep(const BakeState& state) {
    const RefinementClock& c = state.clock;
    const Refinement& r = state.refinement;
    if (r.step == RefinementStep::sweep)
        return c.lines > 0 ? c.sweepSeconds / static_cast<double>(c.lines) * r.lines : 0;
    return c.samples > 0 ? c.directSeconds / static_cast<double>(c.samples) *
                               static_cast<double>(samplesMissing(state))
                         : 0;
}

/// Whether all steps that were asked for have been taken; plans one more if not.
bool isEnough(BakeState& state) {
    const BakeParams& p = state.params;
    const Refinement& r = state.refinement;
    if (r.step != RefinementStep::none) return false;
    if (r.steps > 0 && p.error > 0 && state.report.error.ofTexels() <= p.error) return true;
    if (p.refinements > 0 && r.steps >= p.refinements) return true;
    if (!plan(state)) return true;
    if (p.seconds <= 0 || r.steps == 0) return false;
    const bool late =
        state.clock.elapsed() + secondsOfStep(state) + secondsToFinish(state) > p.seconds;
    if (late) state.refinement.step = RefinementStep::none;
    return late;
}

void announce(const BakeState& state, Progress& progress) {
    const BakeParams& p = state.params;
    if (state.refinement.steps == 0) return progress.stage("last sweep");
    std::string text = "error " + percent(state.report.error.ofTexels());
    if (p.error > 0) text += ", to be " + percent(p.error);
    progress.stage(text + (state.refinement.step == RefinementStep::direct ? ": direct light"
                                                                           : ": one more sweep"));
}

}  // namespace

BakeParams refiningParams(BakeParams p, double error) {
    p.error = error;
    p.directions = 513;
    p.directSamples = 2;
    const double finest = error > 0 ? error : 2e-3;
    p.tolerance = std::clamp(0.2 * finest, 1e-4, 5e-3);
    // So that the noise they hand on is below a quarter of the error.
    const double sweeps = std::pow(4 * kCoarseSweepNoise / finest, 2);
    p.settlingSweeps = std::clamp(static_cast<int>(std::ceil(sweeps)), 1, 8);
    return p;
}

std::int32_t nearestSet(double lines) {
    for (const std::int32_t count : kLineCounts)
        if (count <= kOvershoot * lines) return count;
    return kLineCounts.back();
}

bool refines(const BakeParams& p) {
    return p.error > 0 || p.seconds > 0 || p.refinements > 0;
}

void refine(BakeState& state, Progress& progress,
            const std::function<void(const BakeState&)>& observe) {
    while (!isEnough(state)) {
        progress.check();
        announce(state, progress);
        take(state, progress, observe);
        observe(state);
    }
}

}  // namespace vlf
